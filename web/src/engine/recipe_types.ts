/** The recipe: what is meshed, and how. Lengths mm, patient space RAS. */
import type { RecipeFields } from './generated';

export type { Vec3 } from './generated';

/** The full recipe: every field present. What a link promises and what it shows first are kept apart from it. */
export type Recipe = Omit<RecipeFields, 'expected' | 'view'>;
/** What a case promises of its mesh, and of what is simulated on it where there is anything. */
export type Expected = Pick<RecipeFields['expected'], 'engine' | 'digest' | 'tets'> &
  Partial<Pick<RecipeFields['expected'], 'physics'>> & {
    stages?: Partial<RecipeFields['expected']['stages']>;
  };
export type SharedView = NonNullable<RecipeFields['view']>;

/** At most one is set; none: nothing has been chosen yet. */
export type Source = Recipe['source'];
export type PhantomParams = NonNullable<Source['phantom']>;
export type PhantomKind = PhantomParams['kind'];
/** A file by its name, and the digest of what it holds. */
export type FileSource = Pick<NonNullable<Source['file']>, 'name' | 'sha256'>;

export type SizeRegion = Recipe['sizing']['regions'][number];
export type RegionShape = SizeRegion['shape'];
export type ThicknessSize = Recipe['sizing']['thickness'][number];
export type MaskSize = Recipe['sizing']['masks'][number];
export type CurvatureSize = Recipe['sizing']['curvature'][number];
export type Physics = NonNullable<Recipe['physics']>;
export type TissueKind = Physics['tissue']['kinds'][number];
export type Stimulus = Physics['stimuli'][number];
export type Electrode = NonNullable<Physics['monodomain']>['electrodes'][number];
export type FibreParams = NonNullable<Physics['fibres']>;
export type MonodomainParams = NonNullable<Physics['monodomain']>;
export type BeatParams = NonNullable<Physics['mechanics']>;
export type MuscleMaterial = BeatParams['material'];
export type DiffusionParams = NonNullable<Physics['diffusion']>;
