export default function Sensors() {
  return (
    <main>
      <h1>Sensors</h1>
      <p>What a robot measures, the next chapter tells.</p>
    </main>
  );
}
