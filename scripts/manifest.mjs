// dist/custom-elements.json: what editors and documentation tools know of the elements.
//
// Attributes, events, parts and colours are what the classes' comments say, as the analyzer reads it. Properties are
// made of a table while the script runs, where no analyzer sees them; they are what www/types.d.ts declares. That both
// are true of the elements is tested in a browser.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { ROOT } from './process.mjs';

/** @typedef {{ kind: string, name: string, description?: string, type?: { text: string }, readonly?: true }} Member */

/** @returns {Promise<string>} JSON */
export async function manifest() {
  // @ts-expect-error It comes without types.
  const { cli } = await import('@custom-elements-manifest/analyzer/cli.js');
  const argv = ['analyze', '--litelement', '--quiet', '--globs', 'www/widgets/*/*.js'];
  const { schemaVersion, modules } = await cli({ argv, cwd: ROOT, noWrite: true });
  const types = readFileSync(join(ROOT, 'www/types.d.ts'), 'utf8');
  const shared = membersOf(types, 'WidgetElement');
  /** @type {any[]} */
  const classes = modules.flatMap((/** @type {any} */ { declarations }) => declarations ?? []);
  const declarations = [...types.matchAll(/^ {4}'([\w-]+)': (\w+);$/gm)].map(([, tagName, name]) => {
    const { description, attributes, events, cssParts, cssProperties } = classes.find((each) => each.name === name);
    const members = [...shared, ...membersOf(types, name)];
    return { kind: 'class', name, tagName, customElement: true, description, attributes, events: plain(events), cssParts, cssProperties, members };
  });
  const exports = declarations.map(({ name, tagName }) => ({
    kind: 'custom-element-definition',
    name: tagName,
    declaration: { name, module: 'dist/motion-widgets.js' },
  }));
  const module = { kind: 'javascript-module', path: 'dist/motion-widgets.js', declarations, exports };
  return `${JSON.stringify({ schemaVersion, modules: [module] }, null, 1)}\n`;
}

/**
 * The documented ones, each once, without where the analyzer has them from.
 *
 * @param {{ name: string, type?: object, description?: string }[]} events
 */
function plain(events) {
  const own = events.filter(({ description }) => description).map(({ name, type, description }) => /** @type {const} */ ([name, { name, type, description }]));
  return [...new Map(own).values()];
}

/**
 * @param {string} types
 * @param {string} name of an interface, with one member a line
 * @returns {Member[]}
 */
function membersOf(types, name) {
  const body = types.match(new RegExp(`^export interface ${name}\\b[^{]*\\{\\n([\\s\\S]*?)^\\}`, 'm'))?.[1];
  if (body === undefined) throw new Error(`www/types.d.ts has no interface ${name}.`);
  const member = /(?:^ {2}\/\*\*([\s\S]*?)\*\/\n)?^ {2}(readonly )?(\w+)(\(.*\))?: (.+);$/gm;
  return [...body.matchAll(member)].map(([, comment, readonly, key, parameters, type]) => ({
    kind: parameters ? 'method' : 'field',
    name: key,
    ...(comment && { description: comment.replace(/^\s*\* ?/gm, '').trim() }),
    ...(parameters ? { type: { text: `${parameters} => ${type}` } } : { type: { text: type } }),
    ...(readonly && { readonly: true }),
  }));
}
