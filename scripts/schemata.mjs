// Many mutants in one program: each function holds its own text and the text of each of its mutants, and a number in the
// environment says which of them is executed. Compiling takes longer than running by far, and has to be done once.

import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

/** @typedef {{ line: number, column: number }} Place counted from 1 */
/** @typedef {{ start: Place, end: Place }} Span */
/**
 * @typedef {object} Mutant as `cargo mutants --list --json` tells it
 * @property {string} name
 * @property {string} file
 * @property {Span} span what is replaced
 * @property {string} replacement
 * @property {{ function_name: string, span: Span } | null} function
 */
/** @typedef {{ start: number, end: number }} Range of a text */
/** @typedef {{ file: string, lines: [number, number], number?: number, body: number }} Part of what was written */

/** The environment variable with the number of the mutant that is executed. Without it, or with 0, none is. */
export const CHOSEN = 'MUTANT';

/** A value of CHOSEN: none is executed, and each function with mutants says its number when it is first called. */
export const TELL = 'tell';

/**
 * What is compiled into the crate. A function asks it at each call, which hot loops feel: one load and a comparison.
 *
 * @param {number} bodies
 */
const chooser = (bodies) => `use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering::Relaxed};

const UNKNOWN: usize = usize::MAX;
const TELL: usize = usize::MAX - 1;

static CHOSEN: AtomicUsize = AtomicUsize::new(UNKNOWN);
static TOLD: [AtomicBool; ${bodies}] = [const { AtomicBool::new(false) }; ${bodies}];

#[inline]
pub fn chosen(body: usize) -> usize {
    match CHOSEN.load(Relaxed) {
        UNKNOWN | TELL => look(body),
        number => number,
    }
}

#[cold]
#[inline(never)]
fn look(body: usize) -> usize {
    if CHOSEN.load(Relaxed) == UNKNOWN {
        let wanted = std::env::var("${CHOSEN}").unwrap_or_default();
        CHOSEN.store(if wanted == "${TELL}" { TELL } else { wanted.parse().unwrap_or(0) }, Relaxed);
    }
    let chosen = CHOSEN.load(Relaxed);
    if chosen == TELL && !TOLD[body].swap(true, Relaxed) {
        eprintln!("\\nreached {body}");
    }
    if chosen == TELL { 0 } else { chosen }
}
`;

/**
 * @param {string} text
 * @param {Span} span
 * @returns {Range}
 */
function rangeOf(text, { start, end }) {
  const lines = text.split('\n');
  const at = (/** @type {Place} */ { line, column }) =>
    lines.slice(0, line - 1).reduce((sum, { length }) => sum + length + 1, 0) + column - 1;
  return { start: at(start), end: at(end) };
}

/**
 * @param {string} text
 * @param {Mutant} mutant
 * @returns {string}
 */
export function mutated(text, { span, replacement }) {
  const { start, end } = rangeOf(text, span);
  return text.slice(0, start) + replacement + text.slice(end);
}

/**
 * @param {string} text
 * @param {Mutant} mutant
 * @returns {Range | undefined} the braces of its function, if it is in a function that is executed when the program runs
 */
function bodyOf(text, mutant) {
  if (mutant.function === null) return undefined;
  const { start, end } = rangeOf(text, mutant.function.span);
  // Comments and attributes are in the span, and may hold anything; in their place are as many blanks.
  const code = text.slice(start, end).replace(/\/\/.*|#\[.*\]/g, (found) => ' '.repeat(found.length));
  const head = code.match(/^[^{]*?\bfn\b[^{]*/)?.[0];
  const place = rangeOf(text, mutant.span);
  if (head === undefined || /\bconst\s+fn\b|->\s*impl\b/.test(head) || place.start <= start + head.length) return undefined;
  return { start: start + head.length, end };
}

/**
 * Writes mutants into the sources of a crate.
 *
 * @param {string} root of a copy that is changed
 * @param {Map<number, Mutant>} mutants by their numbers, from 1
 * @returns {{ parts: Part[], bodies: Map<number, number>, outside: number[] }} where each was written; the body that each is
 *   in; those that no function can hold
 */
export function writeSchemata(root, mutants) {
  /** @type {Part[]} */
  const parts = [];
  /** @type {Map<number, number>} */
  const bodies = new Map();
  /** @type {number[]} */
  const outside = [];
  let count = 0;
  for (const file of new Set([...mutants.values()].map((mutant) => mutant.file))) {
    const path = join(root, file);
    const text = readFileSync(path, 'utf8');
    const found = [...mutants].filter(([, mutant]) => mutant.file === file).map(([number, mutant]) => ({ number, mutant, body: bodyOf(text, mutant) }));
    outside.push(...found.filter(({ body }) => body === undefined).map(({ number }) => number));
    // A function inside another is part of its text.
    const ranges = found.flatMap(({ body }) => body ?? []);
    const isOuter = (/** @type {Range} */ a) => !ranges.some((b) => b.start < a.start && a.end <= b.end);
    const outer = new Map(ranges.filter(isOuter).map((range) => [range.start, range]));
    let written = '';
    let done = 0;
    const lines = () => written.split('\n').length;
    for (const { start, end } of [...outer.values()].sort((a, b) => a.start - b.start)) {
      const body = count++;
      written += `${text.slice(done, start)}{ match crate::mutants::chosen(${body}) {\n`;
      for (const { number, mutant, body: own } of found) {
        if (own === undefined || own.start < start || own.end > end) continue;
        const from = lines();
        const after = mutated(text, mutant);
        written += `${number} => ${after.slice(start, after.length - (text.length - end))}\n`;
        parts.push({ file, lines: [from, lines() - 1], number, body });
        bodies.set(number, body);
      }
      const from = lines();
      written += `_ => ${text.slice(start, end)}\n} }`;
      parts.push({ file, lines: [from, lines()], body });
      done = end;
    }
    writeFileSync(path, written + text.slice(done));
  }
  writeFileSync(join(root, 'src/mutants.rs'), chooser(count));
  const lib = join(root, 'src/lib.rs');
  writeFileSync(lib, `${readFileSync(lib, 'utf8')}\n#[doc(hidden)]\nmod mutants;\n`);
  return { parts, bodies, outside };
}
