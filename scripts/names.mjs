// Names in generated code. Each language forbids some names: those get an underscore in Python, and are errors in JavaScript.

/** Keywords of Python that are lower-case letters alone, as settings are. */
const PYTHON_KEYWORDS = new Set(
  ('and as assert async await break class continue def del elif else except finally for from global if import in is lambda ' +
    'nonlocal not or pass raise return try while with yield').split(' '),
);

/** Members of every widget of ipywidgets, which a trait of this name would hide. tests/package/python.test.js looks for more. */
const IPYWIDGET_MEMBERS = new Set(['close', 'comm', 'error', 'keys', 'layout', 'log', 'open', 'stats', 'tabbable', 'tooltip']);

/**
 * Returns the name of a property in Python: in snake case, and with an underscore after a keyword or a member of every widget, as PEP 8
 * recommends. www/anywidget.ts reads traits by this spelling too.
 *
 * @param {string} property
 */
export function pythonNameOf(property) {
  const name = property.replaceAll(/[A-Z]/g, (capital) => `_${capital.toLowerCase()}`);
  if (!/^[a-z]\w*$/.test(name)) throw new Error(`${property} cannot be the name of a trait in Python: rename it.`);
  return PYTHON_KEYWORDS.has(name) || IPYWIDGET_MEMBERS.has(name) ? `${name}_` : name;
}

/**
 * Returns the name of a declaration, such as a class, type or constant, if JavaScript and TypeScript allow it.
 *
 * @param {string} name
 */
export function checkScriptName(name) {
  if (!/^[A-Za-z_$][\w$]*$/.test(name) || isReserved(name)) throw new Error(`${name} cannot name a declaration in JavaScript: rename it.`);
  // A type of this name would hide the one that every script has, as Map or Event.
  if (name in globalThis) throw new Error(`${name} is a global of JavaScript: give the setting or element another name.`);
  return name;
}

/** Returns true if the parser does not accept a word as a name. @param {string} word */
function isReserved(word) {
  try {
    return !new Function(`'use strict'; async () => { const ${word} = 0; };`);
  } catch {
    return true;
  }
}
