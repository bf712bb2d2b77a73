const paper = `@inproceedings{lamecker2009adaptive,
  title     = {Adaptive Tetrahedral Meshing for Personalized Cardiac Simulations},
  author    = {Lamecker, Hans and Mansi, Tommaso and Relan, Jatin and Billet, Florence and
               Sermesant, Maxime and Ayache, Nicholas and Delingette, Herv{\\'e}},
  booktitle = {CI2BM09: MICCAI Workshop on Cardiovascular Interventional Imaging and
               Biophysical Modelling},
  year      = {2009}
}`;

/** BibTeX of this version, and of the article whose method it follows. */
export function citation(version: string): string {
  return `@software{voxtet,
  title   = {voxtet: adaptive tetrahedral meshes from segmented volumes},
  author  = {{voxtet contributors}},
  version = {${version}},
  license = {AGPL-3.0-or-later}
}

${paper}
`;
}
