/** Script of the worker that reads logs. A page that cannot have workers imports `serveRequests` from it. */

import { instantiateShared } from './core.ts';
import { serveRequests } from './logs/worker.ts';

export { serveRequests };

if ('DedicatedWorkerGlobalScope' in globalThis) serveRequests(globalThis as unknown as MessagePort, instantiateShared);
