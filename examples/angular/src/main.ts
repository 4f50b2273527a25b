import { CUSTOM_ELEMENTS_SCHEMA, Component, signal } from '@angular/core';
import { bootstrapApplication } from '@angular/platform-browser';
import 'motion-widgets';

@Component({
  selector: 'app-root',
  schemas: [CUSTOM_ELEMENTS_SCHEMA],
  template: `<nav><button (click)="sensors.set(false)">Motion</button> <button (click)="sensors.set(true)">Sensors</button></nav>
    @if (sensors()) {
      <h1>Sensors</h1>
    } @else {
      <h1>Motion</h1>
      <banana-machine omega="0.8" samples="20000" [alphas]="alphas"></banana-machine>
    }`,
})
class App {
  readonly sensors = signal(false);
  readonly alphas = [0.1, 0.05, 0.05, 0.1, 0.01, 0.01];
}

bootstrapApplication(App);
