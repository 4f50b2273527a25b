// `npm start`: builds stale files and serves dist/ on this machine only. PORT selects a port; the default is the first free one from 4173.

import { createServer } from 'node:http';
import { join } from 'node:path';
import { build } from './build.mjs';
import { ROOT, UserError, runAsScript } from './process.mjs';

/**
 * Serves the files of a directory on localhost.
 *
 * @param {string} directory
 * @param {object} [options]
 * @param {number} [options.port] default: the first free port from 4173 on
 * @param {string} [options.base] path under which the directory is served, with a slash at both ends
 * @param {Record<string, string>} [options.headers] headers of every response
 * @returns {Promise<{ address: string, close: () => void }>}
 */
export async function startServer(directory, { port, base: basePath = '/', headers = {} } = {}) {
  // A static import would fail in a bare clone, in which sirv is not installed yet.
  const { default: sirv } = await import('sirv');
  const serveFile = sirv(directory, { dev: true, etag: true, setHeaders: (response) => response.setHeaders(new Map(Object.entries(headers))) });
  const server = createServer((request, response) => {
    const sendNotFound = () => void response.writeHead(404, { 'content-type': 'text/plain; charset=utf-8' }).end('There is no such page.');
    if (!request.url?.startsWith(basePath)) return sendNotFound();
    request.url = request.url.slice(basePath.length - 1);
    serveFile(request, response, sendNotFound);
  });
  let portToTry = port ?? 4173;
  return new Promise((resolve, reject) => {
    server.on('error', (/** @type {NodeJS.ErrnoException} */ error) => {
      if (error.code !== 'EADDRINUSE' && error.code !== 'EACCES') {
        reject(error);
      } else if (port === undefined) {
        server.listen(++portToTry, 'localhost');
      } else {
        reject(new UserError(`Port ${port} is not free: set PORT to another one, or leave it unset.`));
      }
    });
    server.on('listening', () => {
      const serverAddress = server.address();
      if (serverAddress === null || typeof serverAddress === 'string') return;
      resolve({ address: `http://localhost:${serverAddress.port}${basePath}`, close: () => server.close().closeAllConnections() });
    });
    server.listen(portToTry, 'localhost');
  });
}

/** Returns the port in the environment variable PORT; undefined if it is not set. @returns {number | undefined} */
function readRequestedPort() {
  const [argument] = process.argv.slice(2);
  if (argument !== undefined) throw new UserError(`npm start has no options (got "${argument}"): PORT selects a port, as in PORT=9000 npm start.`);
  const portText = process.env.PORT;
  if (portText === undefined || portText === '') return undefined;
  if (!/^\d+$/.test(portText) || Number(portText) > 65535) {
    throw new UserError(`PORT is "${portText}" and must be a number from 0 (any free port) to 65535.`);
  }
  return Number(portText);
}

await runAsScript(import.meta.url, async () => {
  const port = readRequestedPort();
  await build({ local: true });
  const { address } = await startServer(join(ROOT, 'dist'), { port });
  console.log(`\nThe widgets are at ${address} (Ctrl-C stops).`);
});
