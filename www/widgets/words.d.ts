/** What each widget says, by the key that its messages stand under. */
interface WidgetWords {
  banana: typeof import('./banana-machine/en.js').en;
  squeeze: typeof import('./map-squeeze/en.js').en;
}
