import { BananaMachine, MapSqueeze } from 'motion-widgets/react';
import { Skew } from './skew';

export default function Motion() {
  return (
    <main>
      <h1>Motion</h1>
      <p>A robot that is told to turn does not end where it was told to.</p>
      <BananaMachine omega="0.8" samples={20000} alphas={[0.1, 0.05, 0.05, 0.1, 0.01, 0.01]} />
      <MapSqueeze noise={0.2} start={{ x: 2.05, y: 2.6, theta: 1.5 }} />
      <p>What a figure says, the page may show:</p>
      <Skew />
    </main>
  );
}
