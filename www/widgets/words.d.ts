/** Words of each widget by the key of its messages. */
interface WidgetWords {
  banana: typeof import('./banana-machine/en.ts').en;
  squeeze: typeof import('./map-squeeze/en.ts').en;
  anatomy: typeof import('./arc-anatomy/en.ts').en;
  decomposer: typeof import('./odometry-decomposer/en.ts').en;
  reckoning: typeof import('./dead-reckoning/en.ts').en;
  calibrator: typeof import('./alpha-calibrator/en.ts').en;
}
