/** <map-squeeze>: motion conditioned on a map, and walls across the path that a test of the end pose alone misses. */

import { html, nothing, css } from 'lit';
import { pictureHtml, disclosuresHtml, settingCheckboxHtml, settingRadiosHtml, settingSliderHtml, settingSlidersHtml, legendHtml } from '../../figure/controls.ts';
import { FigureElement } from '../../figure/figure.ts';
import { defineElement } from '../../figure/reflection.ts';
import { words } from '../../messages/registry.ts';
import { MemoizedResult } from '../../scene/cache.ts';
import { verdict as bits } from '../../../build/settings.js';
import { buttonHtml, fieldsetHtml, radioGroupHtml } from '../../ui/controls.ts';
import { Cloud, cloudControlsHtml, cloudProperties, sampleFieldHtml } from '../shared/cloud.ts';
import { PoseHandles } from '../shared/robot.ts';
import { presetButtonsHtml, startOverButtonHtml } from '../shared/controls.ts';
import { describeCommand } from '../shared/sliders.ts';
import { measureCosts, overviewMapHtml, costTableHtml, tallyReadoutsHtml, captionOf, headlineOf, describeMap } from './readouts.ts';
import { applyMap, gridOf, mapDataOf } from './maps/data.ts';
import { MapOpener, userMapControlsHtml } from './maps/opener.ts';
import { FloorPicture } from './picture.ts';
import { LINE_STYLES, OPENING_POSE, PRESET_SETTING, definition, COMMAND_SLIDERS, MAX_SAMPLES, outcomeOf, viewModelOf, type ViewModel } from './settings.ts';
import { WallHandles } from './wall-handles.ts';
import type { StateValues } from '../../figure/settings.ts';
import type { CellGrid } from '../../scene/walls.ts';
import type { MapData, MapSqueeze as Simulation, Motion, Pose } from '../../types.d.ts';
import type { UserMap } from './maps/files.ts';

/** Returns the preset buttons for the apartment. For another map, returns the buttons that go back to the apartment, or restore the initial state. */
function startControlsHtml(figure: MapSqueezeElement) {
  const { userMap } = words.squeeze;
  if (!figure.map) return presetButtonsHtml(figure);
  return html`<div class="buttons presets">
    ${buttonHtml(userMap.leaveLabel, () => figure.openMap(null))} ${startOverButtonHtml(figure)}
  </div>`;
}

function samplerControlsHtml(figure: MapSqueezeElement) {
  const { conditioned, sampler, samples, steps } = figure.viewModel.config;
  const { settings, samplerNames } = words.squeeze;
  // A sample of the sub-stepped sampler takes one draw per sub-step. The maximum number of samples is therefore smaller.
  const maxSampleCountOf = (samplerName: string) => (samplerName === 'sub-stepped' ? Math.floor(MAX_SAMPLES / steps) : MAX_SAMPLES);
  const chooseSampler = (samplerName: string) => figure.gesture.requestAndCommit({ sampler: samplerName, ...(samples > maxSampleCountOf(samplerName) && { samples: maxSampleCountOf(samplerName) }) });
  return html`<div class="judge">
    ${radioGroupHtml(settings.sampler.name, 'sampler', samplerNames, sampler, chooseSampler)}
    ${conditioned && sampler === 'sub-stepped' ? settingSliderHtml(figure, 'steps') : nothing}
  </div>`;
}

/** Returns the controls that users change rarely. If the map has unknown cells, the controls include the treatment of these cells. */
function robotAndMapControlsHtml(figure: MapSqueezeElement, hasUnknownCells: boolean) {
  const { robotAndMapTitle, conditionedLabel, settings, unknownCellNames, viewNames } = words.squeeze;
  return fieldsetHtml(robotAndMapTitle, html`${settingSliderHtml(figure, 'clearance')} ${settingCheckboxHtml(figure, 'conditioned', conditionedLabel)}
    ${hasUnknownCells ? settingRadiosHtml(figure, 'unknown', unknownCellNames) : nothing}
    ${radioGroupHtml(settings.view.name, 'view', viewNames, figure.settings.elementState.view, (viewName) => figure.gesture.setElementField('view', viewName))}`);
}

const styles = css`
  .handle:is(.jamb, .side) {
    --ring: var(--truth);
    width: 1.75em;
    height: 1.75em;
    transform-origin: 0 0;
  }

  .handle:is(.jamb, .side)::after {
    inset: 0.6em;
    border-width: 1.5px;
    border-radius: 1px;
  }

  .handle.side::after {
    inset-inline: 0.2em;
  }

  /* Handles of walls are visible while a pointer is over the picture, and always on touch screens. */
  @media (hover) {
    .stage:not(:hover) .handle.side:not(:focus-visible)::after {
      opacity: 0;
    }
  }

  /* The hint about walls is at the top of the picture, at the same height as the label of the vertical axis. */
  .wall-hint {
    position: absolute;
    top: 0;
    inset-inline-end: 0;
    pointer-events: none;
  }

  .headline {
    margin: 0.15em 0 0;
    font-size: 1.8em;
    line-height: 1.15;
    text-wrap: balance;
  }

  .overview {
    display: none;
  }

  .views {
    margin-bottom: 0.5em;
  }

  /* The picture is as high as possible. The headline, the caption and the presets are in the column next to it. */
  @container (min-width: 38em) {
    .views {
      grid-template-columns: minmax(0, 60svh) minmax(18.25em, 1fr);
    }

    :host([presentation]) .views {
      grid-template-columns: minmax(0, 1fr) 17em;
    }

    canvas {
      aspect-ratio: 4 / 3;
    }
  }

  @container (min-width: 56em) {
    :host(:not([presentation])) .overview {
      display: block;
      width: 11em;
    }
  }

  .own-map .note {
    overflow-wrap: anywhere;
  }

  @media print {
    .own-map :not(.present, :has(.present)) {
      display: none;
    }
  }
`;

/**
 * Motion conditioned on a map, and what the condition cannot see.
 *
 * @attr preset - A place in the apartment to start from; null if the settings match no preset.
 * @attr view - The whole map, or what is near the robot.
 * @attr overlays - The marks and lines that are drawn, separated by spaces in the attribute.
 */
export class MapSqueezeElement extends FigureElement<Simulation, ViewModel> {
  static styles = styles;

  static definition = definition;

  cloud = new Cloud(this, (simulation: Simulation) => simulation.stats.gaveUp);

  picture = new FloorPicture();
  pictures = [this.picture];
  #opener = new MapOpener(this);
  dropHandlers = this.#opener;
  handles: (WallHandles | PoseHandles)[] = [new WallHandles(this), new PoseHandles(this, 'start', ({ clearance }) => clearance, () => this.picture.plan.bounds)];
  /** Value of the field `view` in the latest scene. */
  #shownView = '';
  /** Value of the setting `unknown` (treatment of unknown cells) for which the picture was created. */
  #unknownCellsOfPicture = '';
  /** Measured costs of the samplers, and the settings with which they were measured. */
  #measurement: { config: StateValues, samplerCosts: ReturnType<typeof measureCosts> } | undefined;
  /** Path of the selected sample. */
  #pathMemo: MemoizedResult<Float64Array> = new MemoizedResult();
  /** Cached grid of the map in a simulation, because copying a large grid takes long. */
  #gridMemo: MemoizedResult<CellGrid | null> = new MemoizedResult();

  createSimulation = ({ MapSqueeze }: Motion) => MapSqueeze.empty();

  enterState(simulation: Simulation, state: StateValues) {
    super.enterState(simulation, { ...state, shown: state.map ? 0 : state.shown });
    if (!state.map) return;
    applyMap(simulation, state.map);
    simulation.configureFirst({}, state.shown);
    state.map = mapDataOf(simulation, state.map.name ?? '', this.#gridOf(simulation));
  }

  #gridOf(simulation: Simulation) {
    return this.#gridMemo.getResult([simulation], () => gridOf(simulation));
  }

  onSimulationReplaced() {
    const { simulation } = this;
    if (!simulation) return;
    this.#opener.refusal = undefined;
    this.#unknownCellsOfPicture = this.settings.currentValues.unknown;
    this.picture.setMap(simulation.plan, this.#gridOf(simulation));
  }

  readViewModel(simulation: Simulation) {
    const viewModel = viewModelOf(simulation);
    if (viewModel.config.unknown !== this.#unknownCellsOfPicture && this.picture.grid?.unknown) this.onSimulationReplaced();
    return viewModel;
  }

  get scene() {
    const scene = super.scene;
    const { selectedIndex, isSelectionShown } = this.cloud;
    if (scene.view !== this.#shownView) this.picture.pictureView.clearTarget();
    this.#shownView = scene.view;
    return { ...scene, markedSample: isSelectionShown ? this.#markedSampleOf(selectedIndex) : undefined };
  }

  /** Returns the pose and the path of the marked sample. If the sample was accepted although its path goes through a wall, `contact` is the first point of contact. */
  #markedSampleOf(sampleIndex: number) {
    const { poses, verdicts } = this.currentViewModel;
    const path = this.#pathMemo.getResult([poses, sampleIndex], () => (this.simulation as Simulation).path(sampleIndex));
    const isThroughWall = outcomeOf(verdicts[sampleIndex]) === 'through';
    return { pose: poses.subarray(3 * sampleIndex), path, contact: isThroughWall ? this.simulation?.firstContact(sampleIndex) : undefined };
  }

  get exportData() {
    const { config, poses, verdicts } = this.currentViewModel;
    return {
      settings: { map: this.map?.name ?? null, ...config },
      columns: {
        'x_m y_m theta_rad': poses,
        'end_free path_free accepted': [...verdicts].flatMap((verdict) => [bits.endFree, bits.pathFree, bits.accepted].map((bit) => Math.sign(verdict & bit))),
      },
      linkNote: this.stateLink.lacksMap ? words.squeeze.mapNotInLinkNote : '',
      codeNote: this.map ? words.squeeze.mapNotInCodeNote : '',
    };
  }

  announcementOf = captionOf;

  describePicture = ({ config }: ViewModel) => [words.squeeze.floorTitle, this.#mapDescription, describeCommand(config.command)];

  /** Name of the preset (a place in the apartment); null if the settings match no preset, or if another map is shown. */
  get preset(): string | null {
    return (this.reflection.getProperty('preset') as string | undefined) ?? null;
  }

  set preset(name) {
    this.reflection.setProperty('preset', name, (newName) => {
      const presetSettings = PRESET_SETTING.changesFor(newName, {});
      if (this.map) this.#enterMap(null);
      this.settings.assignValues(presetSettings);
    });
  }

  /**
   * A map of the user's own; null for the apartment.
   *
   * @public
   */
  get map(): MapData | null {
    return this.settings.elementState.map;
  }

  set map(map) {
    const isNameless = typeof map === 'object' && map !== null && !Array.isArray(map) && map.name === undefined;
    this.reflection.setProperty('map', isNameless ? { ...map, name: '' } : map, (newMap) => {
      this.#enterMap(newMap && { name: newMap.name ?? '', applyTo: (simulation) => applyMap(simulation, newMap) });
      this.reflection.updateAttributes();
      this.renderer.requestFrame();
    });
  }

  /** Costs of the samplers with the present settings; undefined if they have not been measured with these settings. */
  get samplerCosts() {
    return this.#measurement?.config === this.settings.currentValues ? this.#measurement.samplerCosts : undefined;
  }

  measureSamplerCosts() {
    this.runtime.attemptWork(() => {
      const { simulation, settings: { currentValues: config } } = this;
      if (simulation) this.#measurement = { config, samplerCosts: measureCosts(simulation, config.steps) };
      this.requestUpdate();
    });
  }

  /** Shows a map of the user, or for null the apartment, as one step that the user can undo. */
  openMap(map: UserMap | null) {
    if (!this.simulation) return;
    this.runtime.attemptWork(() => {
      this.#enterMap(map);
      this.gesture.commitOneStep();
    });
  }

  /** Replaces the map by a plan with moved walls. In the same frame only a few samples are drawn, and the others when the user has stopped moving the wall. */
  moveWalls(walls: Float64Array) {
    const { bounds } = this.picture.plan;
    const name = this.map?.name ?? words.squeeze.editedMapName;
    const applyTo: UserMap['applyTo'] = (simulation) => simulation.setPlan({ bounds: [...bounds], walls });
    this.runtime.attemptOrReport(() => {
      this.#enterMap({ name, applyTo, start: this.settings.requestedValues.start });
      this.gesture.dispatchInput();
    });
    this.renderer.requestFrame();
  }

  /**
   * Puts the robot into a map of the user, or for null into the apartment. The map is tested in a new simulation. If the map or the start pose is refused,
   * the present simulation stays.
   */
  #enterMap(map: UserMap & { start?: Pose } | null) {
    const { motion, settings } = this;
    if (!motion) return;
    settings.applyPending();
    const simulation = motion.MapSqueeze.empty();
    simulation.configureFirst(settings.pickSettings(settings.requestedValues), 0);
    map?.applyTo(simulation);
    // In an occupancy grid, the robot is moved to a free pose, because its present pose may be outside the mapped area.
    const needsFreePose = this.#gridOf(simulation) !== null || !simulation.startFree;
    const startPose = map ? map.start ?? (needsFreePose ? freePoseOf(simulation) : undefined) : OPENING_POSE;
    simulation.configureFirst(startPose ? { start: startPose } : {}, this.cloud.targetCount);
    this.settings.elementState.map = map && mapDataOf(simulation, map.name, this.#gridOf(simulation));
    this.runtime.replaceSimulation(simulation);
    this.cloud.select(-1);
  }

  get #mapDescription() {
    const { pastedMapName, apartmentName } = words.squeeze;
    return describeMap(this.map ? this.map.name || pastedMapName : apartmentName, this.picture.plan);
  }

  renderContent(viewModel: ViewModel) {
    const { posesByOutcome, stats, stuckNote, verdicts } = viewModel;
    const { isSelectionShown, selectedIndex } = this.cloud;
    const hasUnknownCells = this.picture.grid?.unknown !== undefined;
    const { floorTitle, densityNote } = words.squeeze;
    const { unknown, ...markStyles } = LINE_STYLES;
    return html`
      <div class="views">
        ${pictureHtml(this, this.picture, floorTitle, { contentBelow: this.renderer.renderAfterFirstPicture(() => legendHtml(this, hasUnknownCells ? { ...markStyles, unknown } : markStyles)) })}
        ${this.renderer.renderAfterFirstPicture(() => html`<div class="aside">
          <div class="result">
            <p class="headline">${headlineOf(stats)}</p>
            <p class="verdict caption ${stuckNote && 'note'}" part="caption">${captionOf(viewModel)}</p>
          </div>
          ${startControlsHtml(this)} ${samplerControlsHtml(this)} ${overviewMapHtml(this)}
        </div>`)}
      </div>
      ${this.renderer.renderAfterFirstPicture(() => html`
      <div class="controls" part="controls">
        ${fieldsetHtml(words.commandHeading, settingSlidersHtml(this, COMMAND_SLIDERS))} ${fieldsetHtml(words.noiseHeading, settingSliderHtml(this, 'noise'), 'single')} ${cloudControlsHtml(this)}
      </div>
      ${posesByOutcome ? nothing : html`<p class="about muted">${densityNote}</p>`}
      ${disclosuresHtml(this, {
        renderControls: () => html`<div class="controls">${robotAndMapControlsHtml(this, hasUnknownCells)}</div> ${userMapControlsHtml(this, this.#opener, this.#mapDescription)}`,
        renderNumbers: () => html`${tallyReadoutsHtml(viewModel)} ${sampleFieldHtml(this, 'sample', stats.attempts, isSelectionShown && words.squeeze.overlays[outcomeOf(verdicts[selectedIndex])])} ${costTableHtml(this)}`,
      })}`)}
    `;
  }
}

/** Returns a free start pose. If the map has no free pose, returns its middle. */
function freePoseOf({ openPlace, config, plan: { bounds: [xMin, yMin, xMax, yMax] } }: Simulation): Pose {
  return openPlace ?? { ...config.start, x: (xMin + xMax) / 2, y: (yMin + yMax) / 2 };
}

defineElement(MapSqueezeElement, cloudProperties);
