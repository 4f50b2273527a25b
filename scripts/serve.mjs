// `npm start`: builds stale files and serves dist/ on this machine only. PORT selects a port; the default is the first free one from 4173.

import { createReadStream, statSync } from 'node:fs';
import { createServer } from 'node:http';
import { extname, join, normalize, sep } from 'node:path';
import { build } from './build.mjs';
import { Missing, ROOT, runAsScript } from './process.mjs';

const TYPES = /** @type {Record<string, string>} */ ({
  '.css': 'text/css; charset=utf-8',
  '.html': 'text/html; charset=utf-8',
  '.ico': 'image/x-icon',
  '.js': 'text/javascript; charset=utf-8',
  '.json': 'application/json',
  '.map': 'application/json',
  '.mjs': 'text/javascript; charset=utf-8',
  '.png': 'image/png',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
  '.woff2': 'font/woff2',
});

/**
 * @param {string} directory
 * @param {string} base the path that it is served under
 * @param {string} address the path and query of a request
 * @returns {{ path: string, size: number } | undefined} the file meant, never one outside the directory
 */
function fileAt(directory, base, address) {
  try {
    const { pathname } = new URL(address, 'http://localhost');
    if (!pathname.startsWith(base)) return undefined;
    let path = normalize(join(directory, decodeURIComponent(pathname.slice(base.length - 1))));
    if (!path.startsWith(directory + sep)) return undefined;
    if (statSync(path).isDirectory()) path = join(path, 'index.html');
    const { size } = statSync(path);
    return { path, size };
  } catch {
    return undefined;
  }
}

/**
 * @param {string} directory
 * @param {object} [options]
 * @param {number} [options.port] the one to take; without it the first free one from 4173 on
 * @param {string} [options.base] the path that the directory is served under, with a slash at both ends
 * @param {Record<string, string>} [options.headers] sent with every file
 * @returns {Promise<{ address: string, close: () => void }>}
 */
export function serve(directory, { port, base = '/', headers = {} } = {}) {
  const server = createServer((request, response) => {
    const file = fileAt(directory, base, request.url ?? '/');
    if (request.method !== 'GET' && request.method !== 'HEAD') {
      response.writeHead(405, { allow: 'GET, HEAD' }).end();
    } else if (file === undefined) {
      response.writeHead(404, { 'content-type': 'text/plain; charset=utf-8' }).end('There is no such page.');
    } else {
      response.writeHead(200, {
        'content-type': TYPES[extname(file.path)] ?? 'application/octet-stream',
        'content-length': file.size,
        'cache-control': 'no-cache',
        ...headers,
      });
      if (request.method === 'HEAD') response.end();
      else createReadStream(file.path).on('error', () => response.destroy()).pipe(response);
    }
  });
  let candidate = port ?? 4173;
  return new Promise((resolve, reject) => {
    server.on('error', (/** @type {NodeJS.ErrnoException} */ error) => {
      if (error.code !== 'EADDRINUSE' && error.code !== 'EACCES') {
        reject(error);
      } else if (port === undefined) {
        server.listen(++candidate, 'localhost');
      } else {
        reject(new Missing(`Port ${port} is not free: set PORT to another one, or leave it unset.`));
      }
    });
    server.on('listening', () => {
      const address = server.address();
      if (address === null || typeof address === 'string') return;
      resolve({ address: `http://localhost:${address.port}${base}`, close: () => server.close().closeAllConnections() });
    });
    server.listen(candidate, 'localhost');
  });
}

/** @returns {number | undefined} */
function wantedPort() {
  const text = process.env.PORT;
  if (text === undefined || text === '') return undefined;
  if (!/^\d+$/.test(text) || Number(text) > 65535) {
    throw new Missing(`PORT is "${text}" and must be a number from 0 (any free port) to 65535.`);
  }
  return Number(text);
}

await runAsScript(import.meta.url, async () => {
  const port = wantedPort();
  await build({ local: true });
  const { address } = await serve(join(ROOT, 'dist'), { port });
  console.log(`\nThe widgets are at ${address} (Ctrl-C stops).`);
});
