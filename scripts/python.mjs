// Generates sources of the Python package in python/src/motion_widgets: a class for each element, with a trait for each setting. Copies the
// script that shows the elements in notebooks.

import { copyFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { settings } from '../build/settings.js';
import { readClassComments, importTypeScript, joinLines, describeWidgets } from './declarations.mjs';
import { REPOSITORY_ROOT } from './process.mjs';

/**
 * @typedef {import('../build/settings.js').Declaration} Declaration
 * @typedef {import('./declarations.mjs').Field} Field
 */

const PYTHON_DIRECTORY = join(REPOSITORY_ROOT, 'python');

/** Keywords of Python that consist of lower-case letters, as settings do. */
const PYTHON_KEYWORDS = new Set(
  ('and as assert async await break class continue def del elif else except finally for from global if import in is lambda ' +
    'nonlocal not or pass raise return try while with yield').split(' '),
);

/** Members of every widget of ipywidgets, which a trait of the same name would hide. A test fails if a member is missing here. */
const IPYWIDGET_MEMBERS = new Set(['close', 'comm', 'error', 'keys', 'layout', 'log', 'open', 'stats', 'tabbable', 'tooltip']);

/**
 * Returns the name of a property in Python. The name is in snake case. A keyword or a member of every widget gets an underscore, as PEP 8
 * recommends. www/anywidget.ts reads traits by this spelling too.
 *
 * @param {string} propertyName
 */
export function pythonNameOf(propertyName) {
  const snakeCaseName = propertyName.replaceAll(/[A-Z]/g, (capitalLetter) => `_${capitalLetter.toLowerCase()}`);
  if (!/^[a-z]\w*$/.test(snakeCaseName)) throw new Error(`${propertyName} cannot be the name of a trait in Python: rename it.`);
  return PYTHON_KEYWORDS.has(snakeCaseName) || IPYWIDGET_MEMBERS.has(snakeCaseName) ? `${snakeCaseName}_` : snakeCaseName;
}

/** Traits of traitlets for settings without a range. */
const TRAITS_WITHOUT_RANGE = { Bool: 't.Bool(None, allow_none=True)', Dict: 't.Dict(default_value=None, allow_none=True)', Unicode: 't.Unicode(None, allow_none=True)' };

/**
 * Writes the Python module of the elements. Copies anywidget.js and the licences into the package, because pip reads only the directory of
 * the package.
 */
export async function writePython() {
  const sourceDirectory = join(PYTHON_DIRECTORY, 'src/motion_widgets');
  writeFileSync(join(sourceDirectory, '_elements.py'), await createElementsSource());
  copyFileSync(join(REPOSITORY_ROOT, 'dist/anywidget.js'), join(sourceDirectory, 'anywidget.js'));
  for (const licenceFileName of readdirSync(REPOSITORY_ROOT).filter((fileName) => fileName.startsWith('LICENSE'))) {
    copyFileSync(join(REPOSITORY_ROOT, licenceFileName), join(PYTHON_DIRECTORY, licenceFileName));
  }
  copyFileSync(join(REPOSITORY_ROOT, 'dist/LICENSE-third-party.txt'), join(PYTHON_DIRECTORY, 'LICENSE-third-party.txt'));
}

/** Returns the source of the Python module of the elements. */
async function createElementsSource() {
  const { GLOBAL_ATTRIBUTES } = await importTypeScript('www/named.ts');
  const { classes: classesByName } = await readClassComments();
  const widgetClasses = (await describeWidgets()).map(({ tag: widgetTag, className, attributes, properties: elementProperties }) => {
    const documentedFields = [...attributes.map(({ property, name: attributeName, ...otherFields }) => ({ ...otherFields, name: property ?? attributeName })), ...elementProperties];
    const traitFields = documentedFields.filter(({ readonly }) => !readonly).map((settingField) => ({ ...settingField, trait: traitCallOf(settingField, widgetTag) }));
    const globalTraits = GLOBAL_ATTRIBUTES.map((/** @type {string} */ attributeName) => ({ name: attributeName, trait: TRAITS_WITHOUT_RANGE.Unicode, description: `As the attribute \`${attributeName}\` of HTML.` }));
    return { className, tag: widgetTag, sentence: joinLines(classesByName.get(`${className}Element`).description), traits: [...traitFields, ...globalTraits] };
  });
  const sourceLines = [
    '# Generated from the declarations by `npm run build`: not to be edited.',
    '',
    'from __future__ import annotations',
    '',
    'import traitlets as t',
    '',
    'from ._figure import Figure',
    'from ._traits import Group, Number, Sequence, Whole, Word',
    '',
    `__all__ = [${widgetClasses.map(({ className }) => quotePython(className)).join(', ')}]`,
  ];
  for (const { className, tag: widgetTag, sentence: docSentence, traits: traitDeclarations } of widgetClasses) {
    sourceLines.push('', '', '@t.signature_has_traits', `class ${className}(Figure):`, `    """${docSentence}`, '');
    for (const { name: fieldName, description, trait: traitCall } of traitDeclarations) sourceLines.push(`    ${pythonNameOf(fieldName)}:`, `        ${translateNamesToPython(description)}${describeAllowedWords(traitCall)}`);
    sourceLines.push('    """', '', `    widget = t.Unicode(${quotePython(widgetTag)}, read_only=True).tag(sync=True)`);
    for (const { name: fieldName, trait: traitCall } of traitDeclarations) sourceLines.push(`    ${pythonNameOf(fieldName)} = ${traitCall}`);
  }
  return `${sourceLines.join('\n')}\n`;
}

/** Returns the call that creates a trait. @param {Field & { allowed?: string }} field @param {string} widgetTag */
function traitCallOf({ name: fieldName, type: fieldType, allowed: allowedText }, widgetTag) {
  const settingDeclaration = settings[widgetTag].find(({ key: settingKey }) => settingKey === fieldName);
  if (settingDeclaration) return settingTraitCallOf(settingDeclaration, widgetTag);
  if (fieldType === 'number' && allowedText) return `Number(${allowedText.replace(' to ', ', ')})`;
  const allowedWords = [...fieldType.matchAll(/'([^']+)'/g)].map(([, allowedWord]) => quotePython(allowedWord)).join(', ');
  if (fieldType.includes('[]')) return `Sequence(Word(${allowedWords}))`;
  if (allowedWords) return `Word(${allowedWords})`;
  const optionalTrait = { boolean: TRAITS_WITHOUT_RANGE.Bool, number: 'Whole(0)' }[fieldType.replace(' | null', '')];
  return optionalTrait ?? TRAITS_WITHOUT_RANGE.Dict;
}

/** Returns the type of a setting, as Python source. @param {Declaration} declaration @param {string} widgetTag @returns {string} */
function settingTraitCallOf({ key: settingKey, type: fieldType, words: allowedWords = [], min: minValue, max: maxValue }, widgetTag) {
  const rangeText = `${minValue}, ${maxValue}`;
  switch (fieldType) {
    case 'number': return `Number(${rangeText})`;
    case 'whole': return `Whole(${rangeText})`;
    case 'numbers': return `Sequence(Number(${rangeText}))`;
    case 'boolean': return TRAITS_WITHOUT_RANGE.Bool;
    case 'word': return `Word(${allowedWords.map(quotePython).join(', ')})`;
    case 'group': {
      const memberNameOf = (/** @type {Declaration} */ groupMember) => groupMember.field ?? groupMember.key;
      return `Group(${settings[widgetTag].filter((groupMember) => groupMember.in === settingKey).map((groupMember) => `${memberNameOf(groupMember)}=${settingTraitCallOf(groupMember, widgetTag)}`).join(', ')})`;
    }
  }
}

/** Returns the words that a trait accepts, as a sentence. @param {string} traitCall */
function describeAllowedWords(traitCall) {
  const [, sequencePrefix, allowedWords] = traitCall.match(/^(Sequence\()?Word\(([^)]+)\)/) ?? [];
  return allowedWords ? ` ${sequencePrefix ? 'Some' : 'One'} of ${allowedWords}.` : '';
}

/** Constants of JavaScript, with their names in Python. @type {Record<string, string>} */
const PYTHON_CONSTANTS = { null: 'None', true: 'True', false: 'False' };

/** Replaces names of properties and constants by their Python names. @param {string} description text in which properties are in backticks */
const translateNamesToPython = (description) =>
  description.replaceAll(/`([a-z]+[A-Z]\w*)`/g, (_, propertyName) => `\`${pythonNameOf(propertyName)}\``).replaceAll(/\b(null|true|false)\b/g, (constantName) => PYTHON_CONSTANTS[constantName]);

/** Returns a Python string literal. @param {string} stringValue */
const quotePython = (stringValue) => JSON.stringify(stringValue);
