/**
 * The text of a WebAssembly module as a tree.
 *
 * @module
 */

/** @typedef {string | Node[]} Node a word, or what is in brackets */

/**
 * @param {string} text
 * @returns {Node}
 */
export function nodesOf(text) {
  /** @type {Node[]} */
  let open = [];
  const around = [];
  for (const [token] of text.matchAll(/"(?:[^"\\]|\\.)*"|;;.*|[()]|[^\s()"]+/g)) {
    if (token.startsWith(';;')) continue;
    if (token === '(') {
      around.push(open);
      open = [];
    } else if (token === ')') {
      const closed = open;
      open = /** @type {Node[]} */ (around.pop());
      open.push(closed);
    } else open.push(token);
  }
  return open[0];
}

/**
 * @param {Node} node
 * @returns {string}
 */
export function inText(node) {
  return typeof node === 'string' ? node : `(${node.map(inText).join(' ')})`;
}
