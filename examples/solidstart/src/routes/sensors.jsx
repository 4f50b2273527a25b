export default () => <p>No figure here.</p>;
