'use client';

import { useState } from 'react';
import { BananaMachine } from 'motion-widgets/react';

export function Skew() {
  const [skew, setSkew] = useState(0);
  return (
    <>
      <BananaMachine alphas={[0.1, 0.1, 0.1, 0.1, 0, 0]} onStats={({ detail }) => setSkew(detail.crossTrackSkew)} />
      <p>The skew across the track is {skew.toFixed(2)}.</p>
    </>
  );
}
