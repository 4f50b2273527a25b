// `node tests/fuzz/guided.mjs TARGET RUNS SEED`: fuzzing of what JavaScript parses, guided by what of it runs. Its last line
// are the figures.

import { execute } from './executions.js';
import { useMemory } from './in-memory.js';
import { Reached } from './reached.js';

const [name, runs, seed] = process.argv.slice(2);
useMemory();
// Most inputs are refused, and nobody reads where; `npm test` tells it of those that are kept.
Error.stackTraceLimit = 0;
const reached = new Reached();
await reached.start();
console.log(JSON.stringify(await execute(name, Number(runs), Number(seed), reached)));
reached.stop();
