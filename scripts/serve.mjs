// `npm start`: builds stale files and serves dist/ on this machine only. PORT selects a port. The default is the first free port from 4173
// on.

import { once } from 'node:events';
import { createServer } from 'node:http';
import { join } from 'node:path';
import { buildProject } from './build.mjs';
import { REPOSITORY_ROOT, UserError, runAsScript } from './process.mjs';

/**
 * Serves the files of a directory on localhost.
 *
 * @param {string} servedDirectory
 * @param {object} [options]
 * @param {number} [options.port] default: the first free port from 4173 on
 * @param {string} [options.base] path under which the directory is served, with a slash at both ends
 * @param {Record<string, string>} [options.headers] headers of every response
 * @returns {Promise<{ address: string, close: () => void }>}
 */
export async function startServer(servedDirectory, { port, base: basePath = '/', headers: httpHeaders = {} } = {}) {
  // A static import of sirv would fail in a bare clone, in which sirv is not installed yet.
  const { default: sirv } = await import('sirv');
  const serveFile = sirv(servedDirectory, { dev: true, etag: true, setHeaders: (response) => response.setHeaders(new Map(Object.entries(httpHeaders))) });
  const httpServer = createServer((request, response) => {
    const sendNotFound = () => void response.writeHead(404, { 'content-type': 'text/plain; charset=utf-8' }).end('There is no such page.');
    if (!request.url?.startsWith(basePath)) return sendNotFound();
    request.url = request.url.slice(basePath.length - 1);
    serveFile(request, response, sendNotFound);
  });
  for (let portToTry = port ?? 4173; !httpServer.listening; portToTry++) {
    try {
      await once(httpServer.listen(portToTry, 'localhost'), 'listening');
    } catch (error) {
      const { code: errorCode } = /** @type {NodeJS.ErrnoException} */ (error);
      if (errorCode !== 'EADDRINUSE' && errorCode !== 'EACCES') throw error;
      if (port !== undefined) throw new UserError(`Port ${port} is not free: set PORT to another one, or leave it unset.`);
    }
  }
  const { port: openPort } = /** @type {import('node:net').AddressInfo} */ (httpServer.address());
  return { address: `http://localhost:${openPort}${basePath}`, close: () => httpServer.close().closeAllConnections() };
}

/** Returns the port in the environment variable PORT, or undefined if the variable is not set. @returns {number | undefined} */
function readRequestedPort() {
  const [directoryArgument] = process.argv.slice(2);
  if (directoryArgument !== undefined) throw new UserError(`npm start has no options (got "${directoryArgument}"): PORT selects a port, as in PORT=9000 npm start.`);
  const portText = process.env.PORT;
  if (portText === undefined || portText === '') return undefined;
  if (!/^\d+$/.test(portText) || Number(portText) > 65535) {
    throw new UserError(`PORT is "${portText}" and must be a number from 0 (any free port) to 65535.`);
  }
  return Number(portText);
}

await runAsScript(import.meta.url, async () => {
  const port = readRequestedPort();
  await buildProject({ isLocal: true });
  const { address: serverAddress } = await startServer(join(REPOSITORY_ROOT, 'dist'), { port });
  console.log(`\nThe widgets are at ${serverAddress} (Ctrl-C stops).`);
});
