import { computed, signal } from '@preact/signals';
import { stageNames, type ErrorPlace, type StageName, type Vec3 } from '../engine/contract';
import type { Legend } from '../geometry/scale';
import { meshIsGiven, voxelCount } from './case/input';

/** 'label', the name of a field of the mesh, or what the label surface can be coloured by. */
export type ColourBy = string;

/** The label whose share an array holds, or null. */
export function fractionLabel(name: string): number | null {
  const found = /^fraction_(\d+)$/.exec(name);
  return found ? Number(found[1]) : null;
}

export type ThemeChoice = 'system' | 'light' | 'dark';

export interface Cut {
  on: boolean;
  /** Through the elements; else they stay whole. */
  flat: boolean;
  normal: Vec3;
  /** Place of the plane along the normal: 0 and 1 are the ends of the shown body. */
  place: number;
}

/** Elements whose measure lies in a range, chosen by dragging over a histogram. */
export interface Brush {
  /** Name of a field, or 'dihedral_deg': all angles of an element. */
  metric: string;
  lo: number;
  hi: number;
  /** How many elements that is; written by the scene. */
  shown: number | null;
}

export type { Legend } from '../geometry/scale';

/** An element and its numbers. */
export interface Picked {
  title: string;
  lines: [string, string][];
  /** A tetrahedron, or a triangle of a surface stage. */
  stage: StageName;
  element: number;
  /** The half of the view in which it is seen. */
  side: 'left' | 'right';
}

export type ViewDirection = 'R' | 'L' | 'A' | 'P' | 'S' | 'I';

/** Where the camera stands and what it looks at, z upwards. */
export interface Camera {
  position_mm: Vec3;
  target_mm: Vec3;
}

export type SceneCommand =
  | { kind: 'fit' }
  | { kind: 'look'; from: ViewDirection }
  | { kind: 'tell_camera'; take(camera: Camera): void }
  | { kind: 'place_camera'; camera: Camera }
  | { kind: 'cut_facing_me' }
  | { kind: 'picture'; take(picture: Promise<Blob>): void }
  | { kind: 'marked' };

export const stageShown = signal<StageName>('smooth');
export const colourBy = signal<ColourBy>('label');
/** How fibres are drawn, and whether the body is an outline around them. */
export type FibreStyle = 'none' | 'glyphs' | 'lines';
export const fibreStyle = signal<FibreStyle>('none');
export const seeThrough = signal(true);
export const fibreLegend = signal<Legend | null>(null);
export const showEdges = signal(true);
export const cut = signal<Cut>({ on: false, flat: false, normal: [0, 1, 0], place: 0.5 });
export const brush = signal<Brush | null>(null);
/** One element singled out: its id, or nothing. */
export const focusTet = signal<number | null>(null);
export const legend = signal<Legend | null>(null);
/** What a body is coloured by where there is no scale: its labels that are shown. */
export const labelsShown = signal<readonly number[]>([]);
/** Of the fibres where the body is an outline around them, else of the body. */
export const bodyLegend = computed(() =>
  seeThrough.value ? (fibreLegend.value ?? legend.value) : (legend.value ?? fibreLegend.value),
);
/** Of what the slices show, where that is not the labels. */
export const sliceLegend = signal<Legend | null>(null);
export const picked = signal<Picked | null>(null);
/** The label that a press on a slice has found: it is marked where labels are listed. */
export const labelPicked = signal<number | null>(null);
/** Bodies that a case places in the patient: for sizes, or for a simulation. */
export type BodyKind = 'region' | 'stimulus' | 'electrode';
export interface BodyName {
  kind: BodyKind;
  index: number;
}
/** The one whose fields are open and that has handles in the views. */
export const bodyShown = signal<BodyName | null>(null);
export const gizmoMode = signal<'translate' | 'rotate' | 'scale'>('translate');
export type Layout = 'model' | 'slices' | 'compare';
const chosenLayout = signal<Layout>('model');
/** The surface of a volume of fewer voxels is there in a blink: other panes before it would flicker. */
const quickVoxels = 400_000;
/** A case has just been opened: its slices are there long before its surface is, and are shown until it comes. */
const justOpened = signal(false);
export const slicesFirst = computed(
  () => justOpened.value && !meshIsGiven.value && voxelCount.value > quickVoxels,
);
/** One view of the mesh; three slices of the image beside it; or the pinned run beside it. */
export const layout = computed<Layout>(() => (slicesFirst.value ? 'slices' : chosenLayout.value));
export function chooseLayout(next: Layout): void {
  justOpened.value = false;
  chosenLayout.value = next;
}
export function endSlicesFirst(): void {
  justOpened.value = false;
}
/** The crosshair: along each image axis, the fraction of the way from the first voxel to the last. */
export const slicePlaces = signal<Vec3>([0.5, 0.5, 0.5]);
/** What slices show: the labels, the edge length asked for, or how thick the walls are. */
export type SliceOverlay = 'labels' | 'size' | 'thickness';
export const sliceOverlay = signal<SliceOverlay>('labels');
/** How far the labels are pulled apart: 1 doubles the distances of their middles. */
export const explode = signal(0);
export const hiddenLabels = signal<ReadonlySet<number>>(new Set());
/** A click on the mesh excites it there, where a simulation is under way. */
export const stimulating = signal(false);
/** How a body that moves is shown: moved, with an outline of where it was at rest, or at rest. */
export type Motion = 'moved' | 'outline' | 'rest';
export const motion = signal<Motion>('moved');
/** The time cursor of what is played, ms. */
export const time = signal(0);
export const theme = signal<ThemeChoice>('system');
export const dark = signal(false);
/** For projectors: the page some third larger, the views as they are. */
export const largeType = signal(false);
/** Whether there is a view that obeys commands: without WebGL 2 there is none. */
export const sceneMounted = signal(false);
export const command = signal<SceneCommand | null>(null);
/** What an error points at. */
export const marked = signal<ErrorPlace | null>(null);

/** Marks the places of an error on the result that it speaks of, where that is shown at all, and flies there. */
export function showPlace(place: ErrorPlace): void {
  const stage = stageNames.find((name) => name === place.stage);
  if (place.elements.length > 0 && stage) stageShown.value = stage;
  marked.value = place;
  command.value = { kind: 'marked' };
}

export function resetView(): void {
  brush.value = null;
  focusTet.value = null;
  picked.value = null;
  labelPicked.value = null;
  bodyShown.value = null;
  marked.value = null;
  hiddenLabels.value = new Set();
  colourBy.value = 'label';
  sliceOverlay.value = 'labels';
  cut.value = { ...cut.value, on: false, place: 0.5 };
  slicePlaces.value = [0.5, 0.5, 0.5];
  explode.value = 0;
  justOpened.value = true;
}
