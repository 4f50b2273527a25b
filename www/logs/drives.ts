/** Search for the odometry and the reference of each drive in recordings. */

import { GOAL_NAMES, candidates, isTable, likeliest, namesFor, roleByName, seriesNamed, usefulSeries } from './candidates.ts';
import { LogError, listed } from './log-error.ts';
import { ROLES, framesOption, framesText, type Choice, type Frames, type Log, type LogKind, type Recording, type Role, type Series } from './log.ts';
import { isSamePath, pairLogs, pairedByTime, withStart, type Drive } from './pairs.ts';

export type { Drive };

/** Recording, and the choice of a log in it. */
export interface Part { recording: Recording; choice: Choice }

/** Plan of reading: drives with both logs, and single logs that are paired by their times after they are read. */
export interface Plan {
  drives: Record<Role, Part>[];
  unpaired: Record<Role, Part[]>;
  /** True if neither names nor contents of two files are signs of their roles. The first is the odometry then. */
  isByOrder: boolean;
  /** Errors of recordings that are left out, because none of their topics can be read. */
  unused: LogError[];
}

/** Choices of the user. Missing ones are guessed. */
export interface Wishes {
  /** `series` is the name of a series, or a prefix of names without the separator that follows. `frames` selects among transforms. */
  odometry?: { series?: string; frames?: Frames };
  reference?: { series?: string; frames?: Frames };
  /** Kind of odometry: `commands` prefers commands to poses, and `poses` excludes commands. By default poses come first. */
  kind?: LogKind;
  /** Roles that the user gave to recordings with one log. */
  roles?: ReadonlyMap<Recording, Role>;
}

/** Returns the series with their types, for a sentence. */
const described = (series: Series[]) => listed(series.map(({ name, type }) => (name ? `${name} (${type.replace(/^\w+\/(msg\/)?(?=\w+$)/, '')})` : type)));

const isSame = (one: Choice, other?: Choice) => one.series === other?.series && one.frames?.parent === other.frames?.parent && one.frames?.child === other.frames?.child;

/** Assigns the logs of recordings to drives. Throws a LogError, which has a question if the choice is ambiguous. */
export function planDrives(all: Recording[], wishes: Wishes = {}): Plan {
  const useful = all.filter((recording) => wishes.roles?.has(recording) || usefulSeries(recording).length > 0);
  const recordings = useful.length > 0 ? useful : all;
  const unpaired: Plan['unpaired'] = { odometry: [], reference: [] };
  const plan: Plan = { drives: [], unpaired, isByOrder: false, unused: all.filter((each) => !recordings.includes(each)).map(unusable) };
  const unnamed: Recording[] = [];
  for (const recording of recordings) {
    const role = wishes.roles?.get(recording) ?? (recordings.length > 1 ? onlyRole(recording, wishes) : 'both');
    if (role === 'both') plan.drives.push(bothOf(recording, wishes));
    else if (role) plan.unpaired[role].push({ recording, choice: choose(recording, role, wishes) });
    else unnamed.push(recording);
  }
  const { odometry, reference } = unpaired;
  plan.isByOrder = odometry.length + reference.length === 0 && unnamed.length === 2;
  for (const [i, recording] of unnamed.entries()) {
    // If no name is a sign of a role, the order of two files or the roles of the other files determine it.
    const role = plan.isByOrder ? ROLES[i]
      : 2 * odometry.length >= recordings.length ? 'reference'
        : 2 * reference.length >= recordings.length ? 'odometry' : undefined;
    if (!role) throw new LogError({ file: recording.name }, (say) => say.noRole, { what: 'roles', choices: [] });
    plan.unpaired[role].push({ recording, choice: choose(recording, role, wishes) });
  }
  // A separate file of one role replaces the log of that role in a recording that has both.
  const lacking = odometry.length < reference.length ? 'odometry' : 'reference';
  if (plan.drives.length === Math.abs(odometry.length - reference.length)) plan.unpaired[lacking].push(...plan.drives.splice(0).map((drive) => drive[lacking]));
  if (odometry.length !== reference.length) {
    const longer = odometry.length > reference.length ? odometry : reference;
    // If a recording has the other log too, but it is not clear which one it is, that error says more.
    for (const { recording } of longer) attempted(() => bothOf(recording, wishes), ({ ask }) => ask?.what !== 'series');
    const [first] = longer;
    const isRepeated = recordings.length === 2 && recordings[0].name === recordings[1].name;
    const ask = { what: 'roles' as const, choices: [] };
    throw new LogError({ file: first.recording.name }, (say) => (isRepeated ? say.givenTwice : say.unpaired(odometry.length, reference.length)), isRepeated ? undefined : ask);
  }
  return plan;
}

/** Returns the role of a recording among several, by its name or contents; undefined if it has one log without a sign of its role. */
function onlyRole(recording: Recording, wishes: Wishes): Role | 'both' | undefined {
  if (attempted(() => bothOf(recording, wishes))) return 'both';
  const [isOdometry, isReference] = ROLES.map((role) => attempted(() => choose(recording, role, wishes)) !== undefined);
  if (isOdometry !== isReference) return isOdometry ? 'odometry' : 'reference';
  // Several bodies of one file are ambiguous in both roles.
  const couldBeEither = isOdometry || ROLES.every((role) => candidates(recording, role, wishes).some(({ length }) => length > 0));
  if (!couldBeEither) return 'both';
  return roleByName(recording.name) ?? (recording.series.some(({ hasCommands }) => hasCommands) ? 'odometry' : undefined);
}

/** Returns the result of a function, or undefined if it throws an expected LogError. */
function attempted<Result>(work: () => Result, isExpected: (error: LogError) => boolean = () => true): Result | undefined {
  try {
    return work();
  } catch (error) {
    if (error instanceof LogError && isExpected(error)) return undefined;
    throw error;
  }
}

/** Returns both logs of one recording. */
function bothOf(recording: Recording, wishes: Wishes): Record<Role, Part> {
  // A series that the user chose as the reference is not guessed as the odometry.
  const { series, frames } = wishes.reference ?? {};
  const chosenReference = series !== undefined || frames ? choose(recording, 'reference', wishes) : undefined;
  const odometry = attempted(() => choose(recording, 'odometry', wishes, chosenReference)) ?? choose(recording, 'odometry', wishes);
  const reference = chosenReference ?? choose(recording, 'reference', wishes, odometry);
  if (isSame(odometry, reference)) {
    const ask = { what: 'series' as const, role: 'reference' as const, choices: namesFor(recording, 'reference').filter((name) => name !== reference.series) };
    throw new LogError({ file: recording.name, topic: reference.series }, (say) => say.ownReference(reference.frames ? framesText(reference.frames) : reference.series), ask);
  }
  return { odometry: { recording, choice: odometry }, reference: { recording, choice: reference } };
}

/** Returns the choice of a log for a role, different from `other`, the choice for the other role. */
function choose(recording: Recording, role: Role, wishes: Wishes, other?: Choice): Choice {
  const { series, frames } = wishes[role] ?? {};
  return series !== undefined || frames ? wishedChoice(recording, role, wishes) : guessedChoice(recording, role, wishes, other);
}

function wishedChoice(recording: Recording, role: Role, wishes: Wishes): Choice {
  const { series, frames } = wishes[role] ?? {};
  const kind = role === 'reference' ? 'poses' : wishes.kind;
  const found = series === undefined
    ? recording.series.find((each) => each.frames)
    : seriesNamed(recording.series, series);
  if (!found) {
    const names = namesFor(recording, role);
    throw new LogError(
      { file: recording.name, topic: series },
      (say) => (isTable(recording) ? say.noGroup(described(recording.series)) : series === undefined ? say.noTransforms(described(usefulSeries(recording))) : say.noTopic(listed(names))),
      { what: 'series', role, choices: names },
    );
  }
  if (found.kind !== 'transforms' || frames) return { series: found.name, ...(kind && { kind }), ...(frames && { frames }) };
  const [chains = []] = candidates(recording, role, wishes).map((tier) => tier.filter((choice) => choice.series === found.name)).filter(({ length }) => length);
  if (chains.length === 1) return chains[0];
  throw framesError(recording, found, role);
}

function framesError({ name: file }: Recording, { name: topic, frames = [] }: Series, role: Role): LogError {
  const choices = [...new Set([...likeliest(frames, role), ...frames])].map(framesOption);
  return new LogError({ file, topic }, (say) => say.frames(listed(frames.map(framesText))), { what: 'frames', role, choices });
}

function guessedChoice(recording: Recording, role: Role, wishes: Wishes, other?: Choice): Choice {
  const [best = []] = candidates(recording, role, wishes).map((tier) => tier.filter((choice) => !isSame(choice, other))).filter(({ length }) => length);
  // Among the best choices, those with the robot frame of the other log are preferred.
  const alike = best.filter(({ frames }) => frames && frames.child === other?.frames?.child);
  if (alike.length === 1) return alike[0];
  if (best.length === 1) return best[0];
  const file = recording.name;
  const useful = usefulSeries(recording);
  if (useful.length === 0) throw unusable(recording);
  const transforms = useful.filter(({ kind }) => kind === 'transforms');
  if (transforms.length === useful.length) throw framesError(recording, transforms.find((each) => each.frames) ?? transforms[0], role);
  if (role === 'reference' && useful.every(({ kind }) => kind === 'commands')) throw new LogError({ file }, (say) => say.noPoses(described(useful)));
  const positions = useful.filter(({ name, kind }) => kind === 'positions' && !GOAL_NAMES.test(name));
  if (positions.length === useful.length || (role === 'reference' && best.length === 0 && positions.length > 0)) {
    throw new LogError({ file }, (say) => say.positions(described(positions)));
  }
  if (useful.length === 1) {
    const known = knownRole(recording, useful[0]);
    throw new LogError({ file }, (say) => say.alone(described(useful), known), { what: 'other', role: known, choices: [] });
  }
  throw new LogError(
    { file },
    (say) => (best.length > 0 ? say.choose : say.lacks)(role, described(useful)),
    { what: 'series', role, choices: best.length > 0 ? namesFor(recording, role).filter((name) => name !== other?.series) : [] },
  );
}

/** Returns the error of a recording of which no series can be read. */
function unusable({ name: file, series }: Recording): LogError {
  const short = series.find(({ kind }) => kind !== null);
  return new LogError({ file, topic: short?.name }, (say) => (short ? say.noMessages : say.noTopics(described(series))));
}

/** Returns the role of the only series of a recording by its contents or by the name of the file; undefined if neither is a sign. */
function knownRole({ name: file }: Recording, { name, type, kind, hasCommands }: Series): Role | undefined {
  if (kind === 'commands') return 'odometry';
  return roleByName(name) ?? (hasCommands || /Odometry$/.test(type) ? 'odometry' : roleByName(file));
}

/** Reads the logs of a plan and pairs them. Their times are relative to one start. Rejects with a LogError. */
export async function readDrives({ drives, unpaired }: Pick<Plan, 'drives' | 'unpaired'>, onProgress?: (share: number) => void): Promise<Drive[]> {
  const reads = [...drives.map((drive) => [drive.odometry, drive.reference]), ...[...unpaired.odometry, ...unpaired.reference].map((part) => [part])];
  const logs: Log[] = [];
  for (const [i, parts] of reads.entries()) {
    const [{ recording }] = parts;
    logs.push(...(await recording.read(parts.map(({ choice }) => choice), (share) => onProgress?.((i + share) / reads.length))));
  }
  const others = logs.splice(2 * drives.length);
  const pairs: [Log, Log][] = [
    ...drives.map((_, i): [Log, Log] => [logs[2 * i], logs[2 * i + 1]]),
    ...pairedByTime(others.slice(0, unpaired.odometry.length), others.slice(unpaired.odometry.length)),
  ];
  const paired = pairs.map(([odometry, reference]) => pairLogs(odometry, reference));
  const [{ odometry: { start } }] = paired;
  const result = paired.map(({ odometry, reference }) => ({ odometry: withStart(odometry, start), reference: withStart(reference, start) }));
  for (const [i, { odometry }] of result.entries()) {
    const twin = result.slice(0, i).find((other) => isSamePath(other.odometry, odometry));
    if (twin) throw new LogError({ file: odometry.name }, (say) => say.sameDrive(twin.odometry.name));
  }
  return result;
}
