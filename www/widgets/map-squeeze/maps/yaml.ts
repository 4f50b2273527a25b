/** YAML parser, in a separate file that is loaded when it is first needed, and without the library's writer. */

import { YAMLException, load } from 'js-yaml';

export { YAMLException };

/** @throws {YAMLException} */
export function parseYaml(text: string): unknown {
  // Aliases are refused: no map needs them, and with them a short text can expand to billions of values, or contain itself.
  return load(text, { maxAliases: 0 });
}
