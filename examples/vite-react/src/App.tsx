import { useState, useSyncExternalStore } from 'react'
import { BananaMachine, MapSqueeze } from 'motion-widgets/react'

function Motion() {
  const [skew, setSkew] = useState(0)
  return (
    <>
      <h1>Motion</h1>
      <BananaMachine
        omega="0.8"
        samples={20000}
        alphas={[0.1, 0.05, 0.05, 0.1, 0.01, 0.01]}
        onStats={({ detail }) => setSkew(detail.crossTrackSkew)}
      />
      <MapSqueeze noise={0.2} start={{ x: 2.05, y: 2.6, theta: 1.5 }} />
      <p>The skew across the track is {skew.toFixed(2)}.</p>
    </>
  )
}

function subscribe(changed: () => void) {
  addEventListener('hashchange', changed)
  return () => removeEventListener('hashchange', changed)
}

export default function App() {
  const page = useSyncExternalStore(subscribe, () => location.hash)
  return (
    <>
      <nav>
        <a href="#motion">Motion</a> <a href="#sensors">Sensors</a>
      </nav>
      {page === '#sensors' ? <h1>Sensors</h1> : <Motion />}
    </>
  )
}
