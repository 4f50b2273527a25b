import { expect } from '@playwright/test';
import { SIGNATURE, header } from '../png.js';
import { expectAccessible } from './axe.js';
import { file, openSqueeze, pgm, png, squeezed, unfold, yaml } from './squeeze-support.js';
import { STILL, boxOf, frames, pictureOf, pixelsOf, test, unfold as unfoldAll } from './support.js';

/**
 * @typedef {import('./squeeze-support.js').MapFile} MapFile
 * @typedef {import('./squeeze-support.js').MapSqueezeElement} MapSqueezeElement
 * @typedef {import('@playwright/test').Locator} Locator
 */

test.use(STILL);

const ROOM = {
  bounds: [0, 0, 6, 4],
  walls: [[0, 0, 6, 0], [6, 0, 6, 4], [6, 4, 0, 4], [0, 4, 0, 0], [3, 0, 3, 1.5]],
};

/** A room of 60 × 40 cells whose border is occupied. */
const COLUMNS = 60;
const ROWS = 40;
const border = (/** @type {number} */ column, /** @type {number} */ row) =>
  column === 0 || row === 0 || column === COLUMNS - 1 || row === ROWS - 1;

const FIELDS = { image: 'room.pgm', resolution: 0.05, origin: '[0.0, 0.0, 0.0]', negate: 0, occupied_thresh: 0.65, free_thresh: 0.1 };

const complaint = (/** @type {Locator} */ widget) => widget.locator('.own-map .note');
const present = (/** @type {Locator} */ widget) => widget.locator('.own-map .present');

/**
 * Chooses files, as a reader does.
 *
 * @param {Locator} widget
 * @param {MapFile[]} files
 */
async function choose(widget, files) {
  await unfold(widget, 'A map of your own');
  await widget.getByLabel('Map files').setInputFiles(files);
}

/**
 * Drops files on a part of the widget.
 *
 * @param {Locator} part
 * @param {MapFile[]} files
 */
function drop(part, files) {
  return part.evaluate(
    (target, given) => {
      const dataTransfer = new DataTransfer();
      for (const { name, bytes } of given) dataTransfer.items.add(new File([new Uint8Array(bytes)], name));
      const event = (/** @type {string} */ name) => new DragEvent(name, { dataTransfer, bubbles: true, composed: true, cancelable: true });
      const [over, drop] = [event('dragover'), event('drop')];
      target.dispatchEvent(over);
      if (!over.defaultPrevented || !target.closest('.dropping')) throw new Error('It does not take files.');
      target.dispatchEvent(drop);
      if (!drop.defaultPrevented) throw new Error('The browser takes the file.');
      if (target.closest('.dropping')) throw new Error('It is still marked.');
    },
    files.map(({ name, buffer }) => ({ name, bytes: [...buffer] })),
  );
}

test('a JSON floor plan takes the apartment’s place, and the robot finds room in it', async ({ page }) => {
  const widget = await openSqueeze(page);
  const before = await pictureOf(widget.locator('canvas.plane'));
  await widget.getByRole('button', { name: 'Open corridor' }).click();
  await choose(widget, [file('room.json', JSON.stringify(ROOM))]);
  await expect(present(widget)).toHaveText('room.json: 6.0 m × 4.0 m, 5 walls.');
  const { bounds, walls, startFree, openPlace, config, shown } = await squeezed(widget);
  expect(bounds).toEqual(ROOM.bounds);
  expect(walls).toEqual(ROOM.walls.flat());
  // (1.4, 4.4) is outside of it.
  expect(startFree).toBe(true);
  expect(config.start).toEqual(openPlace);
  expect(shown).toBe(config.samples);
  expect(await pictureOf(widget.locator('canvas.plane'))).not.toBe(before);
  await expect(widget.locator('canvas.plane')).toHaveAttribute('aria-label', /room\.json/);

  await widget.getByRole('button', { name: 'Back to the apartment' }).click();
  expect((await squeezed(widget)).bounds).toEqual([0, 0, 12, 9]);
  expect(await pictureOf(widget.locator('canvas.plane'))).toBe(before);
});

test('no place takes the reader’s map away, and the way back is open', async ({ page }) => {
  const widget = await openSqueeze(page);
  await choose(widget, [file('room.json', JSON.stringify(ROOM))]);
  await expect(present(widget)).toContainText('room.json');
  // The places of the apartment are the apartment's.
  for (const name of ['Facing a doorway', 'Facing a wall', 'Open corridor']) {
    await expect(widget.getByRole('button', { name })).toHaveCount(0);
  }
  const open = widget.getByRole('button', { name: 'In the open' });
  await open.click();
  await expect(open).toHaveAttribute('aria-pressed', 'true');
  const { config, openPlace, bounds } = await squeezed(widget);
  expect(config.start).toEqual(openPlace);
  expect(bounds).toEqual(ROOM.bounds);
  await widget.getByRole('slider', { name: 'Robot', exact: true }).press('ArrowRight');
  await expect(open).toHaveAttribute('aria-pressed', 'false');
  const moved = await squeezed(widget);

  await widget.getByRole('button', { name: 'Back to the apartment' }).click();
  await widget.getByRole('button', { name: 'Facing a wall' }).click();
  expect((await squeezed(widget)).bounds).toEqual([0, 0, 12, 9]);
  await widget.getByRole('button', { name: 'Back to room.json' }).click();
  expect(await squeezed(widget)).toEqual(moved);
  await expect(present(widget)).toContainText('room.json');
  await expect(widget.getByRole('button', { name: 'Back to room.json' })).toHaveCount(0);
});

test('without its map, a robot that stood in what is a wall of the apartment has room', async ({ page }) => {
  const widget = await openSqueeze(page);
  const start = await widget.evaluate((element) => {
    const squeeze = /** @type {import('../../www/types.d.ts').MapSqueezeElement} */ (element);
    squeeze.map = { bounds: [0, 0, 12, 9], walls: [] };
    squeeze.x = 4;
    squeeze.y = 2;
    squeeze.map = null;
    return [squeeze.x, squeeze.y];
  });
  expect(start).toEqual([2.05, 2.6]);
  expect((await squeezed(widget)).startFree).toBe(true);
});

test('unknown cells are hatched, and free or blocked as the reader chooses', async ({ page }) => {
  const widget = await openSqueeze(page);
  await expect(widget.getByRole('radiogroup', { name: 'Unknown cells' })).toHaveCount(0);
  // A corridor of 4 m × 1 m, of which the right half is unknown.
  const image = png('map.png', 80, 20, () => false, (column) => column >= 40);
  await choose(widget, [yaml('map.yaml', { ...FIELDS, image: 'map.png', mode: 'scale' }), image]);
  await expect(present(widget)).toContainText('map.yaml');
  // In the left half, of which something is known.
  expect((await squeezed(widget)).config.start.x).toBeLessThan(2);
  await widget.evaluate((element) => Object.assign(element, { theta: 0 }));
  const canvas = widget.locator('canvas.plane');
  const choice = widget.getByRole('radiogroup', { name: 'Unknown cells' });
  await expect(choice.getByLabel('free')).toBeChecked();
  const along = await squeezed(widget);
  const free = await pictureOf(canvas);
  await choice.getByLabel('blocked').check();
  const blocked = await squeezed(widget);
  expect(blocked.config.unknown).toBe('blocked');
  expect(blocked.poses).toEqual(along.poses);
  expect(blocked.stats.accepted).toBeLessThan(along.stats.accepted);
  expect(blocked.walls.length).toBeGreaterThan(along.walls.length);
  expect(await pictureOf(canvas)).not.toBe(free);
  await unfold(widget, 'What is drawn');
  await expect(widget.locator('.key')).toContainText('unknown: the map says nothing');

  // A state has both, and brings both back.
  const state = await widget.evaluate((element) => JSON.stringify(/** @type {any} */ (element).getState()));
  await widget.getByRole('button', { name: 'Back to the apartment' }).click();
  await expect(choice).toHaveCount(0);
  await widget.evaluate((element, text) => /** @type {any} */ (element).setState(JSON.parse(text)), state);
  await expect(choice.getByLabel('blocked')).toBeChecked();
  expect(await squeezed(widget)).toEqual(blocked);
});

test('a robot that has room in a floor plan stays where it is', async ({ page }) => {
  const widget = await openSqueeze(page);
  await choose(widget, [file('room.json', JSON.stringify(ROOM))]);
  await expect(present(widget)).toContainText('room.json');
  expect((await squeezed(widget)).config.start).toEqual({ x: 2.05, y: 2.6, theta: Math.PI / 2 });
});

test('a floor plan can be written on the page', async ({ page }) => {
  const widget = await openSqueeze(page);
  await unfold(widget, 'A map of your own');
  const field = widget.getByLabel('Or a floor plan here');
  const use = widget.getByRole('button', { name: 'Use this plan' });
  // The example in the field is one.
  await use.click();
  await expect(present(widget)).toHaveText('Pasted plan: 6.0 m × 4.0 m, 6 walls.');
  await field.fill('{"bounds": [0, 0, 3, 3],\n"walls": [[0, 0, 3, 3]}');
  await use.click();
  await expect(complaint(widget)).toHaveText(/^Pasted plan, line 2: this is not JSON \(.+\); expected is \{"bounds": .+ in metres\.$/);
  expect((await squeezed(widget)).bounds).toEqual([0, 0, 6, 4]);
  await field.fill(JSON.stringify({ bounds: [0, 0, 3, 3], walls: [[0, 0, 3, 3]] }));
  await use.click();
  await expect(complaint(widget)).toBeHidden();
  expect((await squeezed(widget)).walls).toEqual([0, 0, 3, 3]);
});

for (const place of ['.stage', '.verdict', '.readouts']) {
  test(`a map_server pair can be dropped on the widget, as on its ${place}`, async ({ page }) => {
    const widget = await openSqueeze(page);
    await expect(present(widget)).toHaveCount(0);
    await drop(widget.locator(place).first(), [yaml('room.yaml', FIELDS), pgm('room.pgm', COLUMNS, ROWS, border)]);
    await expect(present(widget)).toContainText('room.yaml: 3.0 m × 2.0 m');
    await expect(present(widget)).toBeVisible();
    const { bounds, walls, startFree, config, openPlace } = await squeezed(widget);
    expect(bounds.map((bound) => Number(bound.toFixed(12)))).toEqual([0, 0, 3, 2]);
    // The outside of the border and its inside.
    expect(walls).toHaveLength(8 * 4);
    expect(startFree).toBe(true);
    expect(config.start).toEqual(openPlace);
    expect(await pixelsOf(widget.locator('canvas.plane'), 'truth')).toBeGreaterThan(1000);
  });
}

test('why a dropped map is refused is seen at once, however far below it is said', async ({ page }) => {
  await page.setViewportSize({ width: 375, height: 812 });
  const widget = await openSqueeze(page);
  const before = await squeezed(widget);
  await widget.locator('.stage').evaluate((stage) => stage.scrollIntoView());
  await drop(widget.locator('.stage'), [file('room.txt', 'a room')]);
  await expect(complaint(widget)).toHaveText(/^room\.txt: this kind of file is not read/);
  // Edges within a pixel of the screen's count for less than all of it.
  await expect(complaint(widget)).toBeInViewport({ ratio: 0.99 });
  await expect(present(widget)).toContainText('The apartment');
  await expect(present(widget)).toBeInViewport({ ratio: 0.99 });
  expect(await squeezed(widget)).toEqual(before);
});

test.describe('occupancy grids', () => {
  /** @type {Record<string, { files: MapFile[], bounds: number[], walls: number }>} */
  const maps = {
    'of 0.03 m, with a yaw': {
      files: [
        yaml('room.yaml', { ...FIELDS, resolution: 0.03, origin: `[1.0, 2.0, ${Math.PI / 2}]` }),
        pgm('room.pgm', COLUMNS, ROWS, border),
      ],
      bounds: [1 - 0.03 * ROWS, 2, 1, 2 + 0.03 * COLUMNS],
      walls: 8,
    },
    'as PNG, in a directory': {
      files: [yaml('map.yml', { ...FIELDS, image: 'maps/room.png' }), png('room.png', COLUMNS, ROWS, border)],
      bounds: [0, 0, 3, 2],
      walls: 8,
    },
    'in mode scale, transparent where nothing is known': {
      files: [
        yaml('room.yaml', { ...FIELDS, image: 'room.png', mode: 'scale' }),
        png('room.png', COLUMNS, ROWS, border, (column) => column < 30),
      ],
      bounds: [0, 0, 3, 2],
      // A bracket, open to the left: its outline has eight sides.
      walls: 8,
    },
    'in mode raw': {
      files: [
        yaml('room.yaml', { ...FIELDS, mode: 'raw' }),
        pgm('room.pgm', COLUMNS, ROWS, border, { black: 100, white: 0 }),
      ],
      bounds: [0, 0, 3, 2],
      walls: 8,
    },
    negated: {
      files: [
        yaml('room.yaml', { ...FIELDS, negate: 1 }),
        pgm('room.pgm', COLUMNS, ROWS, border, { black: 254, white: 0 }),
      ],
      bounds: [0, 0, 3, 2],
      walls: 8,
    },
    'negated in a word': {
      files: [
        yaml('room.yaml', { ...FIELDS, negate: 'Yes' }),
        pgm('room.pgm', COLUMNS, ROWS, border, { black: 254, white: 0 }),
      ],
      bounds: [0, 0, 3, 2],
      walls: 8,
    },
    'of 1000 × 1600 cells': {
      files: [
        yaml('hall.yaml', { ...FIELDS, image: 'hall.pgm', origin: '[-25, -40, 0]' }),
        // 20 000 posts besides the border.
        pgm('hall.pgm', 1000, 1600, (c, r) => c === 0 || r === 0 || c === 999 || r === 1599 || (c % 10 === 5 && r % 8 === 4)),
      ],
      bounds: [-25, -40, 25, 40],
      walls: 8 + 4 * 20_000,
    },
  };
  for (const [name, { files, bounds, walls }] of Object.entries(maps)) {
    test(name, async ({ page }) => {
      const widget = await openSqueeze(page);
      await choose(widget, files);
      await expect(present(widget)).toContainText(files[0].name);
      await expect(complaint(widget)).toBeHidden();
      const now = await squeezed(widget);
      for (const [i, bound] of now.bounds.entries()) expect(bound).toBeCloseTo(bounds[i], 9);
      expect(now.walls).toHaveLength(4 * walls);
      expect(now.startFree).toBe(true);
      expect(now.stats.drawn).toBe(now.config.samples);
    });
  }
});

test.describe('malformed maps', () => {
  const image = pgm('room.pgm', COLUMNS, ROWS, border);
  const good = yaml('room.yaml', FIELDS);
  const whole = png('room.png', COLUMNS, ROWS, border).buffer;
  const half = whole.subarray(0, whole.length / 2);
  const changed = Buffer.from(whole);
  changed[whole.length >> 1] ^= 1;
  /** @type {[string, MapFile[], RegExp][]} */
  const cases = [
    ['a comma missing', [file('plan.json', '{\n"bounds": [0, 0, 1, 1]\n"walls": []}')], /^plan\.json, line 3: this is not JSON .*; expected is \{"bounds"/],
    ['cut short', [file('plan.json', '{"bounds": [0, 0, 1, 1],\n"walls": [[0,')], /^plan\.json, line 2: this is not JSON/],
    ['empty', [file('plan.json', '')], /^plan\.json: this is not JSON/],
    ['another shape', [file('plan.json', '"walls"')], /^plan\.json: plan is "walls"; allowed is an object with keys from bounds, walls; a floor plan is/],
    ['no bounds', [file('plan.json', '{"walls": []}')], /^plan\.json: bounds is missing; allowed is an array of 4 numbers/],
    ['a wall of three numbers', [file('plan.json', '{"bounds": [0, 0, 1, 1], "walls": [[0, 0, 1, 1], [0, 0, 1]]}')], /^plan\.json: walls\[1\] has length 3; allowed is an array of 4 numbers/],
    ['bounds far away', [file('plan.json', '{"bounds": [500000, 5400000, 500010, 5400010], "walls": []}')], /^plan\.json: bounds is \[.*5400000.*\]; allowed is .*; a floor plan is/],
    ['tiny bounds', [file('plan.json', '{"bounds": [0, 0, 1e-9, 1e-9], "walls": []}')], /^plan\.json: bounds.*; a floor plan is/],
    ['a wall outside', [file('plan.json', '{"bounds": [0, 0, 1, 1], "walls": [[0, 0, 2, 1]]}')], /^plan\.json: walls\[0\] ends at .*; allowed is a point inside the bounds/],
    ['broken YAML', [file('room.yaml', 'image: room.pgm\nresolution: 0.05\norigin: [0, 0\nnegate: 0\n'), image], /^room\.yaml, line 4: this is not YAML .*; expected is one field a line/],
    ['YAML without fields', [file('room.yaml', 'room\n'), image], /^room\.yaml: there are no fields in it; expected are/],
    ['no image named', [yaml('room.yaml', { resolution: 0.05 }), image], /^room\.yaml: image is missing; expected is the name/],
    ['no resolution', [yaml('room.yaml', { image: 'room.pgm', origin: '[0, 0, 0]' }), image], /^room\.yaml: resolution is missing; allowed is a number/],
    ['a resolution of 0', [yaml('room.yaml', { ...FIELDS, resolution: 0 }), image], /^room\.yaml: resolution is 0; allowed is a number from 0\.001/],
    ['an origin without yaw', [yaml('room.yaml', { ...FIELDS, origin: '[0, 0]' }), image], /^room\.yaml: origin has length 2; allowed is an array of 3 numbers/],
    ['negate as a word', [yaml('room.yaml', { ...FIELDS, negate: 'maybe' }), image], /^room\.yaml: negate is "maybe"; allowed is/],
    ['an unknown mode', [yaml('room.yaml', { ...FIELDS, mode: 'binary' }), image], /^room\.yaml: mode is "binary"; allowed is "trinary" or "scale" or "raw"/],
    ['thresholds crossed', [yaml('room.yaml', { ...FIELDS, free_thresh: 0.9 }), image], /^room\.yaml: free_thresh is 0\.9; allowed is at most occupied_thresh, 0\.65\.$/],
    ['an image not there', [good], /^room\.yaml: image names room\.pgm, which is not there; expected are both files/],
    ['another image', [good, pgm('hall.pgm', 3, 3, () => false)], /^room\.yaml: image names room\.pgm, which is not there \(hall\.pgm came instead\)/],
    ['an image alone', [image], /^room\.pgm: an image alone has no scale; expected is its \.yaml/],
    ['not a PGM', [good, file('room.pgm', 'JFIF')], /^room\.pgm, line 1: the magic number is "JFIF"; allowed is P5 or P2\.$/],
    ['a PGM of no width', [good, file('room.pgm', 'P5\n# a\nwide 40\n255\n')], /^room\.pgm, line 3: the width is "wide"; allowed is a whole number from 1 to 16777216\.$/],
    ['a PGM cut short', [good, file('room.pgm', 'P5\n60 40\n255\nabc')], /^room\.pgm, line 3: the length of the raster in bytes is 3; allowed is 2400 for 60 × 40 pixels\.$/],
    ['not a PNG', [yaml('room.yaml', { ...FIELDS, image: 'room.png' }), file('room.png', 'GIF89a')], /^room\.png: its first bytes are not those of a PNG image; expected is PNG/],
    ['a PNG cut in half', [yaml('room.yaml', { ...FIELDS, image: 'room.png' }), file('room.png', half)], new RegExp(`^room\\.png: the file ends after ${half.length} bytes, within IDAT; expected is a complete PNG image\\.$`)],
    ['a PNG that was changed', [yaml('room.yaml', { ...FIELDS, image: 'room.png' }), file('room.png', changed)], /^room\.png: IDAT is not what was written; expected is a complete PNG image\.$/],
    ['a map that contains itself', [file('room.yaml', 'image: &a [*a]'), image], /^room\.yaml, line 1: this is not YAML \(aliases exceeded maxAliases \(0\)\); expected is one field a line/],
    ['a value that goes on for ever', [yaml('room.yaml', { ...FIELDS, image: `[${'a, '.repeat(1e4)}]` }), image], /^room\.yaml: image is \["a",[a",]+…; expected is the name of a \.pgm or \.png file\.$/],
    ['a PNG too large to unpack', [yaml('room.yaml', { ...FIELDS, image: 'room.png' }), file('room.png', Buffer.concat([SIGNATURE, header({ width: 100_000, height: 100_000 })]))], /^room\.png: width × height is 100000 × 100000; expected are sides up to/],
    ['a map that reaches too far', [yaml('room.yaml', { ...FIELDS, origin: '[999999, 0, 0]' }), image], /^room\.yaml: origin has the cells from \[999999, 0\] to \[1000002, 2\]; allowed are coordinates from -1000000 to 1000000, and a grid with sides from 0\.01 to 100000\.$/],
    ['too many walls', [good, pgm('room.pgm', 400, 400, (c, r) => c % 2 === 0 && r % 2 === 0)], /^room\.pgm: image has cells in the way with 100\d{3} sides or more; allowed are at most 100000\.$/],
    ['another kind of file', [file('room.txt', 'a room')], /^room\.txt: this kind of file is not read; expected is a \.json floor plan/],
    ['two maps', [good, image, file('plan.json', JSON.stringify(ROOM))], /^plan\.json, room\.yaml: these are 2 maps; expected is one at a time/],
  ];

  test('each is refused in a sentence, and the present map stays', async ({ page }) => {
    const widget = await openSqueeze(page);
    await unfold(widget, 'A map of your own');
    const before = await squeezed(widget);
    const picture = await pictureOf(widget.locator('canvas.plane'));
    for (const [name, files, sentence] of cases) {
      await choose(widget, files);
      await expect(complaint(widget), name).toHaveText(sentence);
      expect(((await complaint(widget).textContent()) ?? '').match(/\.$/), name).not.toBeNull();
      expect(await squeezed(widget), name).toEqual(before);
    }
    expect(await pictureOf(widget.locator('canvas.plane'))).toBe(picture);
    await expect(present(widget)).toContainText('The apartment');
    await expectAccessible(page);

    await choose(widget, [good, image]);
    await expect(present(widget)).toContainText('room.yaml');
    await expect(complaint(widget)).toBeHidden();
  });
});

test('what is transparent in a PNG image keeps its shade', async ({ page }) => {
  const widget = await openSqueeze(page);
  await choose(widget, [
    yaml('room.yaml', { ...FIELDS, image: 'room.png' }),
    png('room.png', COLUMNS, ROWS, border, (column) => column < 30),
  ]);
  await expect(present(widget)).toContainText('room.yaml');
  const occupied = await widget.evaluate((element) => {
    const { grid } = /** @type {MapSqueezeElement} */ (element).machine;
    return grid?.occupied.filter((cell) => cell === 1).length;
  });
  // White stays white: only the border is occupied.
  expect(occupied).toBe(2 * COLUMNS + 2 * (ROWS - 2));
});

test('while an image is decoded the page answers in between where it takes long, and only there', async ({ page }) => {
  const widget = await openSqueeze(page);
  await page.evaluate(() => {
    const counts = { turns: 0, tick: 0 };
    const now = performance.now();
    performance.now = () => now + (counts.tick += counts.tick && 200);
    window.MessageChannel = class extends MessageChannel {
      constructor() {
        super();
        counts.turns++;
      }
    };
    Object.assign(window, { counts });
  });
  for (const [name, tick] of /** @type {[string, number][]} */ ([['quick.yaml', 0], ['slow.yaml', 1]])) {
    await page.evaluate((to) => void Object.assign(Reflect.get(window, 'counts'), { tick: to, turns: 0 }), tick);
    await choose(widget, [yaml(name, { ...FIELDS, image: 'room.png' }), png('room.png', COLUMNS, ROWS, border)]);
    await expect(present(widget)).toContainText(name);
    // A turn for each row of the image where each look at the clock is a fifth of a second later.
    const turns = await page.evaluate(() => Reflect.get(window, 'counts').turns);
    if (tick) expect(turns).toBeGreaterThan(3);
    else expect(turns).toBe(0);
  }
});

test('the whole map includes a cloud that has left it', async ({ page }) => {
  const widget = await openSqueeze(page);
  await unfold(widget, 'What is drawn');
  await widget.getByLabel('whole map').check();
  await choose(widget, [file('small.json', '{"bounds": [0, 0, 2, 2], "walls": [[1, 0, 1, 2]]}')]);
  await expect(present(widget)).toHaveText('small.json: 2.0 m × 2.0 m, 1 wall.');
  await widget.getByLabel('Condition on the map').uncheck();
  await widget.getByRole('slider', { name: 'r, clearance' }).fill('0.4');
  const { poses, bounds, config } = await squeezed(widget);
  const furthest = Math.max(...poses.filter((_, i) => i % 3 === 1));
  expect(furthest).toBeGreaterThan(bounds[3] + 0.5);
  const robot = await boxOf(widget.getByRole('slider', { name: 'Robot', exact: true }));
  const metre = robot.height / (2 * config.clearance);
  const { y: top } = await boxOf(widget.locator('canvas.plane'));
  expect(robot.y + robot.height / 2 - (furthest - config.start.y) * metre).toBeGreaterThan(top + 20);
});

test('a file that cannot be read any more is refused in a sentence', async ({ page }) => {
  const widget = await openSqueeze(page);
  const before = await squeezed(widget);
  await page.evaluate(() => {
    Blob.prototype.arrayBuffer = () => Promise.reject(new DOMException('Permission was lost.', 'NotReadableError'));
  });
  for (const name of ['room.json', 'room.yaml']) {
    await choose(widget, [file(name, JSON.stringify(ROOM))]);
    await expect(complaint(widget)).toHaveText(`${name}: the file cannot be read (NotReadableError); expected is one that is still there.`);
  }
  expect(await squeezed(widget)).toEqual(before);
});

test('what goes wrong beyond the file is said too, and the present map stays', async ({ page }) => {
  const widget = await openSqueeze(page);
  const before = await squeezed(widget);
  await widget.evaluate((element) => {
    const { prototype } = /** @type {MapSqueezeElement} */ (element).motion.MapSqueeze;
    Object.defineProperty(prototype, 'openPlace', { get: () => ({ x: NaN, y: 0, theta: 0 }) });
  });
  await widget.getByRole('button', { name: 'Open corridor' }).click();
  await widget.getByRole('button', { name: 'Facing a doorway' }).click();
  await choose(widget, [file('far.json', '{"bounds": [100, 100, 103, 103], "walls": []}')]);
  await expect(complaint(widget)).toHaveText(/^The map cannot be opened: start\.x is NaN; .+\.$/);
  await expect(present(widget)).toContainText('The apartment');
  expect({ ...(await squeezed(widget)), openPlace: before.openPlace }).toEqual(before);
});

test('a page gives a map: the same again changes nothing, and one that has less is another', async ({ page }) => {
  const widget = await openSqueeze(page);
  const told = await widget.evaluate(async (element, room) => {
    const figure = /** @type {any} */ (element);
    /** @param {any} map @returns {Promise<string>} what comes of it: the map that is there then, why there is none, or that it is as it was */
    const given = (map) => {
      const before = figure.map;
      return new Promise((resolve) => {
        figure.addEventListener('stats', () => resolve(JSON.stringify(Object.keys(figure.map))), { once: true });
        figure.addEventListener('error', (/** @type {ErrorEvent} */ event) => {
          event.preventDefault();
          resolve(event.message);
        }, { once: true });
        figure.map = map;
        // Nothing is on its way then.
        if (figure.map === before && !figure.settings.next) resolve('as it was');
      });
    };
    const empty = { name: 'grid', columns: 8, rows: 1, resolution: 0.5, origin: [0, 0, 0] };
    const known = { ...empty, occupied: 'gA==' };
    const grid = { ...known, unknown: 'AQ==' };
    const all = [];
    for (const map of [room, { ...room }, { ...room, name: 'room' }, room, { bounds: room.bounds }, {}, grid, { ...grid }, known, empty]) all.push(await given(map));
    // Where the robot is wanted then, is wanted in the map before.
    figure.settings.want({ start: { x: 2, y: 2, theta: 0 } });
    await given(grid);
    for (let i = 0; i < 3; i++) await new Promise(requestAnimationFrame);
    all.push(figure.inTheOpen);
    return all;
  }, ROOM);
  expect(told).toEqual([
    '["name","bounds","walls"]', 'as it was', '["name","bounds","walls"]', '["name","bounds","walls"]',
    expect.stringMatching(/^map\.walls is undefined; /), expect.stringMatching(/^map\.(bounds|walls) is undefined; /),
    '["name","columns","rows","resolution","origin","occupied","unknown"]', 'as it was',
    '["name","columns","rows","resolution","origin","occupied"]', expect.stringMatching(/^map\.occupied is undefined; /), true,
  ]);
});

test('the map survives the element’s removal', async ({ page }) => {
  const widget = await openSqueeze(page);
  await choose(widget, [file('room.json', JSON.stringify(ROOM))]);
  await expect(present(widget)).toContainText('room.json');
  const before = await squeezed(widget);
  await widget.evaluate(async (element) => {
    Object.assign(window, { kept: element });
    element.remove();
    await new Promise(requestAnimationFrame);
  });
  await page.evaluate(() => document.querySelector('main')?.prepend(Reflect.get(window, 'kept')));
  await widget.scrollIntoViewIfNeeded();
  await unfold(widget, 'A map of your own');
  await expect(present(widget)).toContainText('room.json');
  expect(await squeezed(widget)).toEqual(before);
});

test.describe('the page', () => {
  test('keeps its roles, its key and its tracks in forced colours', async ({ page }) => {
    await page.emulateMedia({ forcedColors: 'active' });
    const widget = await openSqueeze(page);
    for (const role of ['prior', 'truth']) {
      expect(await pixelsOf(widget.locator('canvas.plane'), role), role).toBeGreaterThan(25);
    }
    await unfold(widget, 'What is drawn');
    const [ring, cross] = await Promise.all(
      ['.through circle:last-child', '.rejected path'].map((mark) =>
        widget.locator(`.key ${mark}`).evaluate((shape) => getComputedStyle(shape).stroke),
      ),
    );
    expect(ring).not.toBe(cross);
    const slider = widget.getByRole('slider', { name: 'n, noise' });
    const withTrack = await slider.screenshot();
    await slider.evaluate((element) => element.style.setProperty('--muted', 'Canvas'));
    expect(withTrack.equals(await slider.screenshot())).toBe(false);
    await expectAccessible(page);
  });

  test('repaints when the colour scheme changes', async ({ page }) => {
    const widget = await openSqueeze(page);
    const canvas = widget.locator('canvas.plane');
    const light = await pictureOf(canvas);
    await page.emulateMedia({ colorScheme: 'dark' });
    await expect.poll(() => pictureOf(canvas)).not.toBe(light);
    await page.emulateMedia({ colorScheme: 'light' });
    await expect.poll(() => pictureOf(canvas)).toBe(light);
  });

  test('fits a phone: nothing to scroll sideways, and targets for a finger', async ({ page }) => {
    await page.setViewportSize({ width: 375, height: 812 });
    const widget = await openSqueeze(page);
    await unfoldAll(widget);
    await widget.getByLabel('sub-stepped').check();
    // At the right edge the handle ahead of the robot has no room to the right.
    await widget.getByRole('button', { name: 'Open corridor' }).click();
    for (let i = 0; i < 10; i++) await widget.getByRole('slider', { name: 'Robot', exact: true }).press('ArrowRight');
    await frames(page);
    const overflow = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
    expect(overflow).toBeLessThanOrEqual(0);
    const targets = widget.locator('button, input, textarea, label:has(input), .handle');
    for (const target of await targets.all()) {
      const inLabel = await target.evaluate((element) => element.matches('label input'));
      if (inLabel) continue;
      const { width, height } = await boxOf(target);
      expect(Math.min(width, height), await target.evaluate((e) => e.outerHTML)).toBeGreaterThanOrEqual(24);
    }
  });

  test('opens close up, and shows the whole map on demand', async ({ page }) => {
    const widget = await openSqueeze(page);
    await unfold(widget, 'What is drawn');
    const canvas = widget.locator('canvas.plane');
    await expect(widget.getByLabel('close-up')).toBeChecked();
    const close = await pictureOf(canvas);
    await widget.getByLabel('whole map').check();
    const seen = await pictureOf(canvas);
    expect(seen === close, 'another picture').toBe(false);
    await widget.getByLabel('close-up').check();
    const again = await pictureOf(canvas);
    expect(again === close, 'the same as before').toBe(true);
  });

  test('the map in the corner takes its walls along to another corner', async ({ page }) => {
    const widget = await openSqueeze(page);
    const canvas = widget.locator('canvas.plane');
    const light = await pictureOf(canvas);
    // Near enough to the opening for the view to stay, and another corner is the freest.
    await widget.evaluate((element) => Object.assign(element, { v: 0.7 }));
    const moved = await pictureOf(canvas);
    expect(moved === light, 'another picture').toBe(false);
    // Other colours, and these again, paint all of it anew.
    await page.emulateMedia({ colorScheme: 'dark' });
    await expect.poll(async () => (await pictureOf(canvas)) === moved).toBe(false);
    await page.emulateMedia({ colorScheme: 'light' });
    await expect.poll(async () => (await pictureOf(canvas)) === moved).toBe(true);
  });

  test('the close-up has the whole map in a corner, in exports too', async ({ page }) => {
    const widget = await openSqueeze(page);
    const drawn = await widget.evaluate((element) => {
      const squeeze = /** @type {import('../../www/types.d.ts').MapSqueezeElement} */ (element);
      // The inside of the axes is one, that of the overview another; of 18 walls each view draws all.
      const count = () => (squeeze.toSVG().match(/<clipPath/g) ?? []).length;
      const close = count();
      squeeze.view = 'whole';
      return [close, count()];
    });
    expect(drawn).toEqual([2, 1]);
  });
});

test.describe('at first glance', () => {
  /** What a reader has to see at once. @param {Locator} widget */
  const essentials = (widget) => [
    widget.locator('canvas.plane'),
    widget.locator('.verdict'),
    widget.locator('.aside .readouts > div').nth(0),
    widget.locator('.aside .readouts > div').nth(1),
    ...['Facing a doorway', 'Facing a wall', 'Open corridor', 'Play', 'Step', 'Reset', 'New seed'].map((name) =>
      widget.getByRole('button', { name }),
    ),
    ...['v,', 'ω,', 'Δt,', 'n, noise', 'r, clearance', 'k, parts', 'N, samples'].map((name) => widget.getByRole('slider', { name })),
    ...['endpoint', 'whole arc', 'sub-stepped'].map((name) => widget.getByRole('radio', { name })),
    widget.getByRole('checkbox', { name: 'Condition on the map' }),
  ];

  for (const [width, height] of [[700, 720], [1280, 720]]) {
    test(`all that matters fits into ${width} × ${height}`, async ({ page }) => {
      await page.setViewportSize({ width, height });
      const widget = await openSqueeze(page);
      // A column as wide as the window.
      await widget.evaluate((element, wide) => {
        document.body.replaceChildren(element);
        document.body.style.cssText = `margin: 0; padding: 0; max-width: none; width: ${wide}px`;
        /** @type {HTMLElement} */ (element).style.cssText = `display: block; width: ${wide}px; margin: 0`;
        scrollTo(0, 0);
      }, width);
      await frames(page);
      for (const part of essentials(widget)) {
        await expect(part).toBeVisible();
        const box = await boxOf(part);
        expect(Math.min(box.x, box.y), String(part)).toBeGreaterThanOrEqual(0);
        expect(box.x + box.width, String(part)).toBeLessThanOrEqual(width);
        expect(box.y + box.height, String(part)).toBeLessThanOrEqual(height);
      }
      expect((await boxOf(widget.locator('canvas.plane'))).height).toBeGreaterThan(300);
    });
  }

  test('on a phone the whole figure has at most 2,000 pixels', async ({ page }) => {
    await page.setViewportSize({ width: 375, height: 812 });
    const widget = await openSqueeze(page);
    expect((await boxOf(widget)).height).toBeLessThan(2000);
  });

  test('many samples are a density, those through a wall in a colour of their own', async ({ page }) => {
    for (const colorScheme of /** @type {const} */ (['light', 'dark'])) {
      await page.emulateMedia({ colorScheme });
      const widget = await openSqueeze(page);
      await unfold(widget, 'What is drawn');
      const about = widget.locator('.about');
      await expect(about).not.toContainText('density');
      await widget.evaluate((element) => Object.assign(element, { samples: 20_000 }));
      await expect(about).toContainText('density');
      expect((await squeezed(widget)).stats.throughWall).toBeGreaterThan(4000);
      // Behind the wall at y = 5 all came through one; between the posts of the doorway, hardly one did.
      const [behind, between] = await widget.evaluate((element) => {
        const { picture: { view }, renderRoot } = /** @type {any} */ (element);
        const canvas = renderRoot.querySelector('canvas.plane');
        const ratio = canvas.width / canvas.clientWidth;
        const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
        const context = /** @type {CanvasRenderingContext2D} */ (copy.getContext('2d', { willReadFrequently: true }));
        context.drawImage(canvas, 0, 0);
        return [[1.75, 5.4], [2.35, 4.2]].map(([x, y]) => {
          const [left, top] = [ratio * view.toPixelX(x) - 8, ratio * view.toPixelY(y) - 8];
          const { data } = context.getImageData(left, top, 16, 16);
          let sum = 0;
          for (let i = 0; i < data.length; i += 4) sum += data[i + 3] * (data[i + 1] - data[i + 2]);
          return sum;
        });
      });
      // Purple has more blue than green, orange more green than blue.
      expect(behind, colorScheme).toBeLessThan(0);
      expect(between, colorScheme).toBeGreaterThan(0);
      await widget.evaluate((element) => Object.assign(element, { samples: 600 }));
      await expect(about).not.toContainText('density');
    }
  });
});
