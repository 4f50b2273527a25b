// What the share of mutants that the tests notice rests on: a sample that anyone can draw again, every mutant in its place in
// the common program, and the interval of the share.

import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { inOrderOf, wilson } from '../../scripts/mutants.mjs';
import { writeSchemata } from '../../scripts/schemata.mjs';

const SOURCE = `/// A comment with { in it, of (a function) fn.
pub fn area(a: f64, b: f64) -> f64 {
    let side = |x: f64| -x;
    a * side(b)
}
const TWO: f64 = -2.0;
`;

/**
 * The mutant with something in the place of what stands first after `from`.
 *
 * @param {string} text
 * @param {string} replacement
 */
function mutant(text, replacement, { from = 'pub', inFunction = true } = {}) {
  const at = SOURCE.indexOf(text, SOURCE.indexOf(from));
  const place = (/** @type {number} */ index) => {
    const before = SOURCE.slice(0, index).split('\n');
    return { line: before.length, column: before[before.length - 1].length + 1 };
  };
  const span = { start: place(at), end: place(at + text.length) };
  const whole = { start: { line: 1, column: 1 }, end: { line: 5, column: 2 } };
  return { name: `${text} ${at}`, file: 'src/lib.rs', span, replacement, function: inFunction ? { function_name: 'area', span: whole } : null };
}

test('each mutant has a text of its own in the common program', (t) => {
  const root = mkdtempSync(join(tmpdir(), 'mutants-'));
  t.after(() => rmSync(root, { recursive: true }));
  mkdirSync(join(root, 'src'));
  writeFileSync(join(root, 'src/lib.rs'), SOURCE);
  const mutants = new Map([
    [4, mutant('*', '+')],
    [7, mutant('-', '', { from: '|x' })],
    [9, mutant('-', '', { from: 'const', inFunction: false })],
  ]);
  const { parts, bodies, outside } = writeSchemata(root, mutants);
  assert.deepEqual(outside, [9], 'a constant is compiled alone');
  assert.deepEqual([...bodies], [[4, 0], [7, 0]]);
  const lines = readFileSync(join(root, 'src/lib.rs'), 'utf8').split('\n');
  const textOf = (/** @type {number | undefined} */ number) => {
    const [from, to] = parts.find((part) => part.number === number)?.lines ?? [];
    return lines.slice(Number(from) - 1, to).join('\n');
  };
  assert.equal(textOf(4), '4 => {\n    let side = |x: f64| -x;\n    a + side(b)\n}');
  assert.equal(textOf(7), '7 => {\n    let side = |x: f64| x;\n    a * side(b)\n}');
  assert.match(textOf(undefined), /^_ => \{\n {4}let side = \|x: f64\| -x;\n {4}a \* side\(b\)\n\}/);
  assert.equal(lines[1], 'pub fn area(a: f64, b: f64) -> f64 { match crate::mutants::chosen(0) {');
  assert.match(lines.join('\n'), /\nconst TWO: f64 = -2\.0;\n/);
});

test('a seed is an order', () => {
  const names = (/** @type {{ name: string }[]} */ list) => list.map(({ name }) => name);
  const all = Array.from({ length: 200 }, (_, i) => ({ ...mutant('*', '+'), name: `mutant ${i}` }));
  const one = names(inOrderOf('1', all));
  assert.deepEqual(names(inOrderOf('1', [...all].reverse())), one, 'whatever order they are listed in');
  assert.notDeepEqual(names(inOrderOf('2', all)), one);
  assert.deepEqual([...one].sort(), names(all).sort());
  // Of a tenth, the mean place in the list is 100 with a deviation of 12.2.
  const mean = one.slice(0, 20).reduce((sum, name) => sum + Number(name.slice(7)), 0) / 20;
  assert.ok(Math.abs(mean - 99.5) < 4 * 12.2, `${mean}`);
});

// Newcombe, Statistics in Medicine 17 (1998), table I.
test("the interval is Wilson's", () => {
  for (const [hits, n, low, high] of [[81, 263, 0.2553, 0.3662], [15, 148, 0.0624, 0.1605], [0, 20, 0, 0.1611], [1, 29, 0.0061, 0.1718]]) {
    const [from, to] = wilson(hits, n);
    assert.ok(Math.abs(from - low) < 5e-5 && Math.abs(to - high) < 5e-5, `${hits} of ${n}: ${from} to ${to}`);
  }
});
