/** Script of the worker that reads logs. A page that cannot have workers imports `LogSession` from it. */

import { expose, proxy } from 'comlink';
import { instantiateShared, type SharedCore } from './core.ts';
import { LogSession } from './logs/session.ts';

export { LogSession };

/** Starts a session with the WebAssembly module that the page has compiled. */
export const startSession = async (sharedCore: SharedCore) => proxy(new LogSession(await instantiateShared(sharedCore)));

if ('DedicatedWorkerGlobalScope' in globalThis) expose(startSession);
