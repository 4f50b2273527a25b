// Names in generated code. Each language forbids some names. A forbidden name gets an underscore in Python, and is an error in JavaScript.

/** Keywords of Python that consist of lower-case letters, as settings do. */
const PYTHON_KEYWORDS = new Set(
  ('and as assert async await break class continue def del elif else except finally for from global if import in is lambda ' +
    'nonlocal not or pass raise return try while with yield').split(' '),
);

/**
 * Members of every widget of ipywidgets, which a trait of the same name would hide. tests/package/python.test.js looks for missing ones.
 */
const IPYWIDGET_MEMBERS = new Set(['close', 'comm', 'error', 'keys', 'layout', 'log', 'open', 'stats', 'tabbable', 'tooltip']);

/**
 * Returns the name of a property in Python. The name is in snake case. A keyword or a member of every widget gets an underscore, as PEP 8
 * recommends. www/anywidget.ts reads traits by this spelling too.
 *
 * @param {string} propertyName
 */
export function pythonNameOf(propertyName) {
  const snakeCaseName = propertyName.replaceAll(/[A-Z]/g, (capital) => `_${capital.toLowerCase()}`);
  if (!/^[a-z]\w*$/.test(snakeCaseName)) throw new Error(`${propertyName} cannot be the name of a trait in Python: rename it.`);
  return PYTHON_KEYWORDS.has(snakeCaseName) || IPYWIDGET_MEMBERS.has(snakeCaseName) ? `${snakeCaseName}_` : snakeCaseName;
}

/** Returns the name of a declaration, such as a class, type or constant, if JavaScript and TypeScript allow it. @param {string} scriptName */
export function checkScriptName(scriptName) {
  if (!/^[A-Za-z_$][\w$]*$/.test(scriptName) || isReserved(scriptName)) throw new Error(`${scriptName} cannot name a declaration in JavaScript: rename it.`);
  // A declared type of this name would hide a global type of every script, such as Map or Event.
  if (scriptName in globalThis) throw new Error(`${scriptName} is a global of JavaScript: give the setting or element another name.`);
  return scriptName;
}

/** Returns true if the JavaScript parser does not accept a word as a name. @param {string} identifier */
function isReserved(identifier) {
  try {
    return !new Function(`'use strict'; async () => { const ${identifier} = 0; };`);
  } catch {
    return true;
  }
}
