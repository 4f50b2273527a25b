/** Reader of YAML, in a file of its own to be loaded when it is first needed, and without the library's writer. */

import { YAMLException, load } from 'js-yaml';

export { YAMLException };

/** @throws {YAMLException} */
export function parseYaml(text: string): unknown {
  // No map repeats itself, and by repetition a short text says a billion things, or one that contains itself.
  return load(text, { maxAliases: 0 });
}
