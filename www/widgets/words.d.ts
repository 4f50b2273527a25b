/** What each widget says, by the key that its messages stand under. */
interface WidgetWords {
  banana: typeof import('./banana-machine/en.js').en;
  squeeze: typeof import('./map-squeeze/en.js').en;
  anatomy: typeof import('./arc-anatomy/en.js').en;
  decomposer: typeof import('./odometry-decomposer/en.js').en;
  reckoning: typeof import('./dead-reckoning/en.js').en;
  calibrator: typeof import('./alpha-calibrator/en.js').en;
}
