// Sources of the Python package: python/src/motion_widgets gets the script, and a class for each element with a trait for
// each declared setting.

import { copyFileSync, readdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { settings } from '../www/settings.js';
import { comments, oneLine, widgets } from './declarations.mjs';
import { pythonName } from './names.mjs';
import { ROOT } from './process.mjs';
import { importTypeScript } from './typescript.mjs';

/**
 * @typedef {import('../www/settings.js').Declaration} Declaration
 * @typedef {import('./declarations.mjs').Named} Named
 */

const PYTHON = join(ROOT, 'python');

/** Traits of traitlets for settings without a range. */
const OPTIONAL = { Bool: 't.Bool(None, allow_none=True)', Dict: 't.Dict(default_value=None, allow_none=True)', Unicode: 't.Unicode(None, allow_none=True)' };

/** Writes the generated files, and copies the others: pip reads only its own directory. */
export async function writePython() {
  const sources = join(PYTHON, 'src/motion_widgets');
  writeFileSync(join(sources, '_elements.py'), await elements());
  copyFileSync(join(ROOT, 'dist/anywidget.js'), join(sources, 'anywidget.js'));
  for (const license of readdirSync(ROOT).filter((name) => name.startsWith('LICENSE'))) {
    copyFileSync(join(ROOT, license), join(PYTHON, license));
  }
  copyFileSync(join(ROOT, 'dist/LICENSE-third-party.txt'), join(PYTHON, 'LICENSE-third-party.txt'));
}

/** @returns {Promise<string>} a module of Python */
export async function elements() {
  const { GLOBAL_ATTRIBUTES: GLOBAL } = await importTypeScript('www/named.ts');
  const { classes } = await comments();
  const all = (await widgets()).map(({ tag, machine, attributes, properties }) => {
    const documented = [...attributes.map(({ property, name, ...rest }) => ({ ...rest, name: property ?? name })), ...properties];
    const traits = documented.filter(({ readonly }) => !readonly).map((each) => ({ ...each, trait: traitOf(each, tag) }));
    const global = GLOBAL.map((/** @type {string} */ name) => ({ name, trait: OPTIONAL.Unicode, description: `As the attribute \`${name}\` of HTML.` }));
    return { machine, tag, sentence: oneLine(classes.get(`${machine}Element`).description), traits: [...traits, ...global] };
  });
  const lines = [
    '# Generated from the declarations by `npm run build`: not to be edited.',
    '',
    'from __future__ import annotations',
    '',
    'import traitlets as t',
    '',
    'from ._figure import Figure',
    'from ._traits import Group, Number, Sequence, Whole, Word',
    '',
    `__all__ = [${all.map(({ machine }) => text(machine)).join(', ')}]`,
  ];
  for (const { machine, tag, sentence, traits } of all) {
    lines.push('', '', '@t.signature_has_traits', `class ${machine}(Figure):`, `    """${sentence}`, '');
    for (const { name, description, trait } of traits) lines.push(`    ${pythonName(name)}:`, `        ${inPython(description)}${wordsOf(trait)}`);
    lines.push('    """', '', `    widget = t.Unicode(${text(tag)}, read_only=True).tag(sync=True)`);
    for (const { name, trait } of traits) lines.push(`    ${pythonName(name)} = ${trait}`);
  }
  return `${lines.join('\n')}\n`;
}

/** Returns the call that creates a trait. @param {Named & { allowed?: string }} named @param {string} tag */
function traitOf({ name, type, allowed }, tag) {
  const declaration = settings[tag].find(({ key }) => key === name);
  if (declaration) return settingOf(declaration, tag);
  if (type === 'number' && allowed) return `Number(${allowed.replace(' to ', ', ')})`;
  const words = [...type.matchAll(/'([^']+)'/g)].map(([, word]) => text(word)).join(', ');
  if (type.includes('[]')) return `Sequence(Word(${words}))`;
  if (words) return `Word(${words})`;
  const kind = { boolean: OPTIONAL.Bool, number: 'Whole(0)' }[type.replace(' | null', '')];
  return kind ?? OPTIONAL.Dict;
}

/** Returns the type of a setting, as Python source. @param {Declaration} declaration @param {string} tag @returns {string} */
function settingOf({ key, type, words = [], fields = [], min, max }, tag) {
  const range = `${min}, ${max}`;
  switch (type) {
    case 'number': return `Number(${range})`;
    case 'whole': return `Whole(${range})`;
    case 'numbers': return `Sequence(Number(${range}))`;
    case 'boolean': return OPTIONAL.Bool;
    case 'word': return `Word(${words.map(text).join(', ')})`;
    case 'group': {
      const nameOf = (/** @type {Declaration} */ part) => part.field ?? part.key;
      const parts = settings[tag].filter((part) => part.in === key && fields.includes(nameOf(part)));
      return `Group(${parts.map((part) => `${nameOf(part)}=${settingOf(part, tag)}`).join(', ')})`;
    }
  }
}

/** Returns the words that a trait takes, as a sentence. @param {string} trait */
function wordsOf(trait) {
  const [, list, words] = trait.match(/^(Sequence\()?Word\(([^)]+)\)/) ?? [];
  return words ? ` ${list ? 'Some' : 'One'} of ${words}.` : '';
}

/** Constants of JavaScript that have other names in Python. @type {Record<string, string>} */
const WORDS = { null: 'None', true: 'True', false: 'False' };

/** @param {string} description in which what stands between backticks may be a property */
const inPython = (description) =>
  description.replaceAll(/`([a-z]+[A-Z]\w*)`/g, (_, name) => `\`${pythonName(name)}\``).replaceAll(/\b(null|true|false)\b/g, (word) => WORDS[word]);

/** @param {string} value */
const text = (value) => JSON.stringify(value);
