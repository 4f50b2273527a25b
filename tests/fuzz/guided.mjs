// `node tests/fuzz/guided.mjs TARGET RUNS SEED`: fuzzing of what JavaScript parses, guided by what of it runs. Its last line
// are the figures.

import { Reached } from './reached.js';
import { execute } from './executions.js';

const [name, runs, seed] = process.argv.slice(2);
const reached = new Reached();
await reached.start();
console.log(JSON.stringify(await execute(name, Number(runs), Number(seed), reached)));
reached.stop();
