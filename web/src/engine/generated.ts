// Made from schema.json by generate_contract.mjs.

export type Vec3 = [number, number, number];

/** Every field of the recipe, as the engine declares them. */
export interface RecipeFields {
  /** Version of the recipe's format; absent: the first. */
  version: number;
  source: {
    phantom?: {
      /** Which body. */
      kind: 'sphere' | 'shell' | 'torus' | 'slab' | 'nested_boxes' | 'branching_tube' | 'biventricle' | 'atlas';
      /** Distance between voxel centres along the image axes; mm. */
      spacing_mm: Vec3;
      /** Rotation of the image axes about x, then y, then z; deg. */
      rotation_deg: Vec3;
      /** First image axis reversed. */
      mirrored: boolean;
      /** Radius: sphere, shell (outer), torus (major); half size of the boxes; mm. */
      radius_mm: number;
      /** Inner radius of the shell, minor radius of the torus; mm. */
      inner_radius_mm: number;
      /** Thickness of the slab; mm. */
      thickness_mm: number;
      /** Biventricle and atlas: size, 1 is an adult's. */
      scale: number;
      /** Biventricle: amplitude of the seeded roughness of the walls; mm. */
      roughness_mm: number;
      /** Biventricle: factor on the LV wall's thickness, which grows outwards; the cavities stay. */
      wall_scale: number;
      /** Biventricle: factor on the length of both cavities along the LV's axis; widths and walls stay. */
      length_scale: number;
      /** Biventricle: factor on the depth of the RV cavity, from the septum to the free wall. */
      rv_dilation: number;
      /** Biventricle: thickness of the RV free wall at scale 1, which grows outwards; mm. */
      rv_wall_mm: number;
      /** Biventricle: label the cavities as 3 and 4. */
      blood_pools: boolean;
      /** Biventricle: scar core 5, crossed by an isthmus, with border zone 6. */
      scar: boolean;
      /** Biventricle: place of the scar around the LV, 0 is antero-lateral, 37 lateral, 127 inferior, -53 anterior, -143 septal; deg. */
      scar_angle_deg: number;
      /** Biventricle: place of the scar along the LV's axis at scale 1, from 0 in the middle; positive: towards the base; mm. */
      scar_height_mm: number;
      /** Biventricle: width of the scar core around the LV, in the middle of the wall at scale 1; mm. */
      scar_arc_mm: number;
      /** Biventricle: length of the scar core along the LV's axis at scale 1; mm. */
      scar_length_mm: number;
      /** Biventricle: share of the wall that the scar core fills, from inside. */
      scar_depth: number;
      /** Biventricle: width of the border zone around the core at scale 1; 0: none; mm. */
      border_mm: number;
      /** Biventricle: width of the isthmus at scale 1; 0 closes it; mm. */
      isthmus_mm: number;
      /** Atlas: number of labels. */
      regions: number;
      /** Biventricle: seed of the roughness. Atlas: seed of the regions. */
      seed: number;
    };
    inline?: {
      /** Name of the file that it was read from. */
      name: string;
      /** The labels and their affine, coded, as base64url. */
      data: string;
    };
    file?: {
      /** Name of the file that holds the volume, or a mesh that was made elsewhere. */
      name: string;
      /** Digest of its voxels and affine, or of its mesh; empty accepts any. */
      sha256: string;
      /** Address where the file can be had. */
      url: string;
    };
    /** Unit of the file's lengths, whatever it says; file: as it says. */
    unit: 'file' | 'm' | 'cm' | 'mm' | 'um' | 'nm';
    /** Segments by name or label: where segments overlap the first of these wins, and else the last of the file. */
    precedence: string[];
    /** Value of the file that is its background. */
    background: number;
    /** Frame of a file with several, counted from 0; -1: none is chosen. */
    frame: number;
    threshold?: {
      /** Smallest value that becomes label 1. */
      lower: number;
      /** Largest value that becomes label 1. */
      upper: number;
    };
  };
  /** Names and colours of labels, before those of the file. */
  legend: {
    /** The label. */
    label: number;
    /** What it is called, in exports too; empty: as in the file. */
    name: string;
    /** Its colour as #rrggbb; empty: as in the file. */
    colour: string;
  }[];
  /** Labels to mesh; none: all. */
  labels: number[];
  /** Groups of labels; each is meshed as one region. */
  merge: number[][];
  volume: {
    /** Slices thicker than so many pixels are interpolated to voxels; 0 never does. */
    slice_ratio: number;
    /** Pieces of a label with fewer voxels are removed, but never its largest; 0 keeps all; voxel. */
    speck_voxels: number;
    /** Enclosed pieces of background with fewer voxels are filled; 0 keeps all; voxel. */
    hole_voxels: number;
    /** Handles, tunnels and pits one voxel wide are opened, closed or filled if fewer voxels change; 0 keeps all; voxel. */
    handle_voxels: number;
    /** Faces at which the image cuts a body off are flat, with a sharp rim and a name. */
    flat_border: boolean;
    /** Planes at which labels are cut off: flat faces with a sharp rim and a name. */
    cut: {
      /** Name of the surface in the plane; empty: cut, cut_2, ... */
      name: string;
      /** Labels that are cut; none: all. */
      labels: number[];
      /** A point of the plane; RAS; mm. */
      point_mm: Vec3;
      /** Direction across the plane; what it points to is cut away; RAS. */
      normal: Vec3;
    }[];
    /** Thick slices that are shifted against each other, as by breath-holds, are put back. */
    align_slices: boolean;
    /** No slice is moved farther, unless slice_shifts says so; mm. */
    largest_shift_mm: number;
    /** Moves of single thick slices in their plane, instead of found ones. */
    slice_shifts: {
      /** Slice of the file, counted from 0. */
      slice: number;
      /** Move along the first of the slice's two image axes; mm. */
      first_mm: number;
      /** Move along the second of the slice's two image axes; mm. */
      second_mm: number;
    }[];
  };
  surface: {
    /** How the label surface is extracted; auto: by the number of labels. */
    method: 'auto' | 'marching_cubes' | 'marching_tets';
  };
  smooth: {
    /** Bi-Laplacian steps, and as many again for thick regions of several labels; 0 leaves the staircase. */
    iterations: number;
    /** Step of each iteration. */
    step: number;
    /** How far a vertex may move along each image axis; voxel. */
    max_move_voxels: number;
    /** Across thick slices vertices may move as if so much of a slice were a voxel; 0: they may not. */
    slice_share: number;
    /** Restore each label's volume after smoothing. */
    keep_volume: boolean;
  };
  sizing: {
    /** Edge length wherever nothing smaller is asked; mm. */
    edge_mm: number;
    /** Edge length inside single labels, instead of edge_mm. */
    labels: {
      /** The label. */
      label: number;
      /** Edge length inside it; mm. */
      edge_mm: number;
    }[];
    /** Places with their own edge length. */
    regions: {
      /** Name of the region. */
      name: string;
      /** Shape of the region. */
      shape: 'sphere' | 'box' | 'capsule';
      /** Centre of sphere or box, first end of a capsule; RAS; mm. */
      centre_mm: Vec3;
      /** Second end of a capsule; RAS; mm. */
      end_mm: Vec3;
      /** Half edges of a box; mm. */
      half_size_mm: Vec3;
      /** Rotation of a box about x, then y, then z; deg. */
      axes_deg: Vec3;
      /** Radius of sphere or capsule; mm. */
      radius_mm: number;
      /** Edge length inside; mm. */
      edge_mm: number;
      /** Width of the band around it over which the size returns to its surroundings'; mm. */
      band_mm: number;
    }[];
    /** Edge length growing with the distance to a label. */
    distances: {
      /** The label from which distance is measured. */
      label: number;
      /** Edge length at the label; mm. */
      edge_mm: number;
      /** Growth of the edge length per mm of distance; mm/mm. */
      slope: number;
    }[];
    /** Edge length by the thickness of a wall, instead of edge_mm there. */
    thickness: {
      /** Labels of the image that form the wall. */
      wall: number[];
      /** Labels on its inner side (blood pools); none: the cavities of the background. */
      inner: number[];
      /** Elements asked for across the wall; 0: the ranges below instead. */
      layers: number;
      /** How the layers are had: size: by the size of elements alone; exact: by sheets across the wall, with one element between two of them. */
      layering: 'size' | 'exact';
      /** Edge length where the wall is thin; mm. */
      edge_thin_mm: number;
      /** Edge length where the wall is thick; mm. */
      edge_thick_mm: number;
      /** Thickness that is thin; 0 with thick_mm 0: the first percentile; mm. */
      thin_mm: number;
      /** Thickness that is thick; 0 with thin_mm 0: the last percentile; mm. */
      thick_mm: number;
    }[];
    /** Edge lengths painted over the volume. */
    masks: {
      /** Name of the file that holds the mask, a label volume on any grid. */
      name: string;
      /** Digest of its voxels and affine, or of its mesh; empty accepts any. */
      sha256: string;
      /** Edge length where the mask has a label. */
      edges: {
        /** The label. */
        label: number;
        /** Edge length inside it; mm. */
        edge_mm: number;
      }[];
    }[];
    /** Images of edge lengths, instead of edge_mm where they have one. */
    images: {
      /** Name of the file (NIfTI) that holds edge lengths in mm, on any grid. */
      name: string;
      /** Digest of its voxels and affine, or of its mesh; empty accepts any. */
      sha256: string;
    }[];
    /** Edge length by the curvature of the label surface. */
    curvature: {
      /** Labels whose surfaces count; none: all. */
      labels: number[];
      /** Edges to a full turn of the surface's circle of curvature. */
      edges_per_turn: number;
      /** No edge length below this is asked, however sharp the bend; mm. */
      edge_min_mm: number;
    }[];
    /** Edge length by the error that it causes in the speed of an excitation wave. */
    waves: {
      /** Labels in which; none: all. */
      labels: number[];
      /** Speed of the wave in its slowest direction, across the fibres; mm/ms. */
      speed_mm_per_ms: number;
      /** Error of its speed that the mesh may cause; %. */
      error_percent: number;
      /** Share of the consistent mass in the simulation to come; explicit: 0. */
      consistent_mass: number;
    }[];
    /** No edge length below this is asked; mm. */
    edge_min_mm: number;
    /** No edge length above this is asked; mm. */
    edge_max_mm: number;
    /** Bound on how fast the edge length may change per mm; mm/mm. */
    gradation: number;
  };
  remesh: {
    /** How the adapted surface is made. */
    method: 'delaunay' | 'adapt';
    /** What makes method delaunay give way to adapt: a lost or self-touching label, any change of topology, or nothing. */
    keep_topology: 'labels' | 'all' | 'nothing';
    /** delaunay: lower bound on the triangles' angles; deg. */
    facet_angle_deg: number;
    /** delaunay: distance allowed from triangles to labels; voxel. */
    max_distance_voxels: number;
    /** adapt: adaptive, or the paper's coarsen, refine, optimise. */
    schedule: 'adaptive' | 'paper';
    /** adapt: weight of shape against size when points are moved. */
    shape_weight: number;
    /** adapt: check every operation for intersections; slow. */
    verify: boolean;
  };
  tetra: {
    /** Which mesher fills the surface. */
    backend: 'tetgen' | 'delaunay';
    /** Bound on circumradius over shortest edge. */
    radius_edge: number;
    /** tetgen: smallest dihedral angle that refinement aims at; 0: none; deg. */
    min_dihedral_deg: number;
    /** tetgen: largest dihedral angle that its optimisation aims at; deg. */
    max_dihedral_deg: number;
  };
  optimise: {
    /** Rounds of work on badly shaped tetrahedra; 0 leaves them. */
    rounds: number;
    /** Tetrahedra with a smaller dihedral angle are worked on; deg. */
    min_dihedral_deg: number;
    /** Where tetrahedra stay below this, vertices are inserted, and those on the surface slide; deg. */
    insertion_deg: number;
    /** How far from the label surface vertices may slide, as a part of the target edge length; 0: not at all. */
    slide: number;
  };
  transfer: {
    /** Labels of the image to transfer to the tetrahedra, meshed or not. */
    labels: number[];
    /** Samples of each tetrahedron, at least. */
    samples_min: number;
    /** Samples of each tetrahedron, at most. */
    samples_max: number;
  };
  quality: {
    /** Bins of each histogram. */
    histogram_bins: number;
    /** Spacing of the samples that distances are measured at; voxel. */
    sample_spacing_voxels: number;
  };
  physics?: {
    anatomy?: {
      /** Meshed labels of the ventricles' wall, with scar; none: all but the pools. */
      wall: number[];
      /** Labels of the left cavity, meshed or not; none: found as a cavity of the wall. */
      lv_pool: number[];
      /** Labels of the right cavity. */
      rv_pool: number[];
    };
    fibres?: {
      /** linear: angles linear in the depth of the wall; bayer: as published in 2012. */
      rule: 'linear' | 'bayer';
      /** Helix angle at the endocardium; deg. */
      alpha_endo_deg: number;
      /** Helix angle at the epicardium; deg. */
      alpha_epi_deg: number;
      /** Sheet angle at the endocardium; deg. */
      beta_endo_deg: number;
      /** Sheet angle at the epicardium; deg. */
      beta_epi_deg: number;
      septum?: {
        /** Helix angle at the endocardium; deg. */
        alpha_endo_deg: number;
        /** Helix angle at the epicardium; deg. */
        alpha_epi_deg: number;
        /** Sheet angle at the endocardium; deg. */
        beta_endo_deg: number;
        /** Sheet angle at the epicardium; deg. */
        beta_epi_deg: number;
      };
    };
    tissue: {
      /** Where a tetrahedron's label comes from: the mesh, or labels transferred to it by centroid, majority or as fractions. */
      by: 'mesh' | 'centroid' | 'majority' | 'fraction';
      /** Kinds of tissue; labels without an entry do not conduct. */
      kinds: {
        /** Labels that are this kind of tissue. */
        labels: number[];
        /** Speed of a plane wave along the fibres, in rested tissue; mm/ms. */
        along_mm_per_ms: number;
        /** Speed across the fibres; counts where there are fibres; mm/ms. */
        across_mm_per_ms: number;
        /** Mitchell and Schaeffer's cell, or that of Corrado and Niederer, which never paces itself. */
        cell: 'ms' | 'mms';
        /** Time of the inward current: how fast cells depolarise; ms. */
        tau_in_ms: number;
        /** Time of the outward current; more than four times tau_in_ms; ms. */
        tau_out_ms: number;
        /** Time in which the gate opens again: how fast cells recover; ms. */
        tau_open_ms: number;
        /** Time in which the gate closes: how long an action potential lasts; ms. */
        tau_close_ms: number;
        /** Voltage, as a part of its range, at which the gate turns. */
        gate: number;
      }[];
    };
    /** Where and when the tissue is excited from outside. */
    stimuli: {
      /** Name of the stimulus. */
      name: string;
      /** Shape of the region. */
      shape: 'sphere' | 'box' | 'capsule';
      /** Centre of sphere or box, first end of a capsule; RAS; mm. */
      centre_mm: Vec3;
      /** Second end of a capsule; RAS; mm. */
      end_mm: Vec3;
      /** Half edges of a box; mm. */
      half_size_mm: Vec3;
      /** Rotation of a box about x, then y, then z; deg. */
      axes_deg: Vec3;
      /** Radius of sphere or capsule; mm. */
      radius_mm: number;
      /** When it is first given; ms. */
      start_ms: number;
      /** How long the current flows; ms. */
      duration_ms: number;
      /** The current, as a part of the voltage's range each ms; 1/ms. */
      strength_per_ms: number;
      /** How often it is given (S1). */
      count: number;
      /** From one start to the next; ms. */
      interval_ms: number;
      /** Interval of one extra stimulus after these (S2); 0: none; ms. */
      s2_ms: number;
      /** Interval of one more after that (S3); 0: none; ms. */
      s3_ms: number;
    }[];
    monodomain?: {
      /** Steps in time: semi_implicit, with half-lumped mass, for results; explicit, with lumped mass, for a quick look. */
      integration: 'explicit' | 'semi_implicit';
      /** Time at the end; ms. */
      end_ms: number;
      /** Time step; ms. */
      step_ms: number;
      /** Time between two frames; ms. */
      frame_ms: number;
      /** semi_implicit: share of the consistent mass; the rest is lumped. */
      consistent_mass: number;
      /** Correct each tetrahedron's conductivity so that the wave has its speed on this mesh too, by what was measured on others. */
      correct_speed: boolean;
      /** Places where the extracellular potential is recorded. */
      electrodes: {
        /** Name of the electrode. */
        name: string;
        /** Where it is; RAS; mm. */
        at_mm: Vec3;
      }[];
    };
    mechanics?: {
      /** Elements: p1_anp, linear with pressures averaged at points; p1_stabilised, linear with stabilised pressures; p1, which locks; p2, quadratic. */
      element: 'p1_anp' | 'p1_stabilised' | 'p1' | 'p2';
      /** Fibres at four places of each tetrahedron, not at its centroid alone; needs physics.fibres. */
      fine_fibres: boolean;
      material: {
        transversely_isotropic?: {
          /** c1 of c1 (I1 - 3) + c2 (I2 - 3), all around; kPa. */
          c1_kpa: number;
          /** c2 of the same; kPa. */
          c2_kpa: number;
          /** Stiffness of stretched fibres; kPa. */
          a_f_kpa: number;
          /** How fast fibres stiffen. */
          b_f: number;
        };
        holzapfel_ogden?: {
          /** Stiffness all around; kPa. */
          a_kpa: number;
          /** How fast it stiffens. */
          b: number;
          /** Stiffness along fibres; kPa. */
          a_f_kpa: number;
          /** How fast they stiffen. */
          b_f: number;
          /** Stiffness along sheets; kPa. */
          a_s_kpa: number;
          /** How fast they stiffen. */
          b_s: number;
          /** Stiffness against shear of fibres and sheets; kPa. */
          a_fs_kpa: number;
          /** How fast that stiffens. */
          b_fs: number;
          /** How sharply fibres and sheets slacken when they are pressed. */
          k: number;
        };
        guccione?: {
          /** Stiffness; kPa. */
          c_kpa: number;
          /** Exponent along fibres. */
          b_f: number;
          /** Exponent across fibres. */
          b_t: number;
          /** Exponent of shears of fibres. */
          b_fs: number;
        };
        mooney_rivlin?: {
          /** c1 of c1 (I1 - 3) + c2 (I2 - 3); kPa. */
          c1_kpa: number;
          /** c2 of the same; 0: neo-Hookean; kPa. */
          c2_kpa: number;
        };
        corotational?: {
          /** Shear modulus across fibres; kPa. */
          shear_across_kpa: number;
          /** Shear modulus along them; kPa. */
          shear_along_kpa: number;
          /** What fibres add to the stiffness along them; kPa. */
          fibre_kpa: number;
        };
      };
      /** Where muscle is stiffer or contracts less than elsewhere. */
      labels: {
        /** Labels of the wall that are another muscle. */
        labels: number[];
        /** Factor of the material's stresses. */
        stiffness: number;
        /** Factor of the active stress; 0: none, as in a scar. */
        contractility: number;
      }[];
      /** Resistance to a change of volume; kPa. */
      bulk_kpa: number;
      /** Resistance to the rate of strain; kPa s. */
      viscosity_kpa_s: number;
      /** Density; kg/m3. */
      density_kg_per_m3: number;
      contraction: {
        /** Published active stress: fast, ambit or elastodynamics. */
        preset: 'fast' | 'ambit' | 'elastodynamics';
        lv?: {
          /** Stress to which the muscle would come in the end; kPa. */
          peak_kpa: number;
          /** How fast it comes; 1/s. */
          rise_per_s: number;
          /** How fast it goes; 1/s. */
          fall_per_s: number;
          /** How long switching takes; 0: none; ms. */
          switch_ms: number;
        };
        rv?: {
          /** Stress to which the muscle would come in the end; kPa. */
          peak_kpa: number;
          /** How fast it comes; 1/s. */
          rise_per_s: number;
          /** How fast it goes; 1/s. */
          fall_per_s: number;
          /** How long switching takes; 0: none; ms. */
          switch_ms: number;
        };
        /** What activates a place: the eikonal map, the first wave of the monodomain model, or nothing but time (synchronous). */
        by: 'eikonal' | 'monodomain' | 'synchronous';
        /** Time of the beat at which that map begins; ms. */
        start_ms: number;
        /** From activation to recovery, where the map does not say it; ms. */
        duration_ms: number;
      };
      support: {
        /** Springs on the epicardium, along its normal; kPa/mm. */
        epicardium_kpa_per_mm: number;
        /** Springs on the base, in all directions; kPa/mm. */
        base_kpa_per_mm: number;
        /** Dampers beside both; kPa s/mm. */
        damping_kpa_s_per_mm: number;
      };
      windkessel: {
        systemic: {
          /** Resistance of the vessels; kPa s/ml. */
          resistance_kpa_s_per_ml: number;
          /** Compliance of the arteries; ml/kPa. */
          compliance_ml_per_kpa: number;
          /** Impedance of the great artery; kPa s/ml. */
          impedance_kpa_s_per_ml: number;
          /** Pressure into which the vessels drain; kPa. */
          venous_kpa: number;
          /** Pressure of the atrium at rest; kPa. */
          atrium_kpa: number;
          /** Pressure at the height of its contraction; kPa. */
          kick_kpa: number;
          /** When it contracts in each beat; s. */
          kick_start_s: number;
          /** How long it does; s. */
          kick_s: number;
        };
        pulmonary: {
          /** Resistance of the vessels; kPa s/ml. */
          resistance_kpa_s_per_ml: number;
          /** Compliance of the arteries; ml/kPa. */
          compliance_ml_per_kpa: number;
          /** Impedance of the great artery; kPa s/ml. */
          impedance_kpa_s_per_ml: number;
          /** Pressure into which the vessels drain; kPa. */
          venous_kpa: number;
          /** Pressure of the atrium at rest; kPa. */
          atrium_kpa: number;
          /** Pressure at the height of its contraction; kPa. */
          kick_kpa: number;
          /** When it contracts in each beat; s. */
          kick_start_s: number;
          /** How long it does; s. */
          kick_s: number;
        };
        /** Pressure in the arteries as the first beat begins; kPa. */
        systemic_start_kpa: number;
        /** The same of the lung's; kPa. */
        pulmonary_start_kpa: number;
        /** Share of its conductance with which the pulmonary valve leaks. */
        regurgitation: number;
      };
      closed_loop?: {
        left_atrium: {
          /** Elastance that contraction adds; kPa/ml. */
          active_kpa_per_ml: number;
          /** Elastance at rest; kPa/ml. */
          passive_kpa_per_ml: number;
          /** Volume without pressure; ml. */
          unloaded_ml: number;
          /** When it contracts in each beat; s. */
          start_s: number;
          /** How long it contracts; s. */
          contraction_s: number;
          /** How long it relaxes; s. */
          relaxation_s: number;
        };
        right_atrium: {
          /** Elastance that contraction adds; kPa/ml. */
          active_kpa_per_ml: number;
          /** Elastance at rest; kPa/ml. */
          passive_kpa_per_ml: number;
          /** Volume without pressure; ml. */
          unloaded_ml: number;
          /** When it contracts in each beat; s. */
          start_s: number;
          /** How long it contracts; s. */
          contraction_s: number;
          /** How long it relaxes; s. */
          relaxation_s: number;
        };
        systemic_arteries: {
          /** Resistance; kPa s/ml. */
          resistance_kpa_s_per_ml: number;
          /** Compliance; ml/kPa. */
          compliance_ml_per_kpa: number;
          /** Inertance; kPa s2/ml. */
          inertance_kpa_s2_per_ml: number;
        };
        systemic_veins: {
          /** Resistance; kPa s/ml. */
          resistance_kpa_s_per_ml: number;
          /** Compliance; ml/kPa. */
          compliance_ml_per_kpa: number;
          /** Inertance; kPa s2/ml. */
          inertance_kpa_s2_per_ml: number;
        };
        pulmonary_arteries: {
          /** Resistance; kPa s/ml. */
          resistance_kpa_s_per_ml: number;
          /** Compliance; ml/kPa. */
          compliance_ml_per_kpa: number;
          /** Inertance; kPa s2/ml. */
          inertance_kpa_s2_per_ml: number;
        };
        pulmonary_veins: {
          /** Resistance; kPa s/ml. */
          resistance_kpa_s_per_ml: number;
          /** Compliance; ml/kPa. */
          compliance_ml_per_kpa: number;
          /** Inertance; kPa s2/ml. */
          inertance_kpa_s2_per_ml: number;
        };
        /** Share of its conductance with which the pulmonary valve leaks. */
        regurgitation: number;
      };
      /** Length of a beat; ms. */
      period_ms: number;
      /** Beats at most. */
      beats: number;
      /** Ends sooner where no ventricle's volume at the end of a beat differs by more from the one before; 0: never; %. */
      cycle_percent: number;
      /** Before the first beat, pressures rise from 0 to those of the atria; ms. */
      fill_ms: number;
      /** The longest time step; halved where that is too long; ms. */
      step_ms: number;
      /** Time between two frames; ms. */
      frame_ms: number;
    };
    diffusion?: {
      /** Label from which heat spreads. */
      from: number;
      /** Diffusivity, the same everywhere; mm2/ms. */
      diffusivity_mm2_per_ms: number;
      /** Time at the end; ms. */
      end_ms: number;
      /** Time step; ms. */
      step_ms: number;
      /** Time between two frames; ms. */
      frame_ms: number;
    };
  };
  limits: {
    /** Most tetrahedra; a case forecast to have more is refused. 0: no limit. */
    tets: number;
    /** Most memory, by forecast; 0: no limit; MB. */
    memory_mb: number;
    /** Most time, by forecast; 0: no limit; s. */
    seconds: number;
  };
  expected: {
    /** Version of voxtet that made the mesh. */
    engine: string;
    /** SHA-256 of the mesh's points, tetrahedra and labels. */
    digest: string;
    /** Number of tetrahedra. */
    tets: number;
    /** Version of the physics that was simulated; empty: none is promised. */
    physics: string;
    stages: {
      /** Digest of the activation map; empty: none is promised. */
      eikonal: string;
      /** Digest of the wave; empty: none is promised. */
      monodomain: string;
      /** Digest of the beating heart; empty: none is promised. */
      mechanics: string;
    };
  };
  view?: {
    /** Stage whose result is shown; empty: the last one. */
    stage: string;
    /** Field that the mesh is coloured by; empty: labels. */
    colour: string;
    /** The body alone, or beside slices of the image. */
    layout: 'model' | 'slices';
    camera?: {
      /** Where it stands; RAS; mm. */
      position_mm: Vec3;
      /** What it looks at; RAS; mm. */
      target_mm: Vec3;
    };
    cut?: {
      /** Direction of the side that is taken away; RAS. */
      normal: Vec3;
      /** How far along it the plane lies: 0 and 1 are the ends of the body. */
      place: number;
      /** Through the elements; else they stay whole. */
      flat: boolean;
    };
    /** Place of the slices, as a fraction of the image along its axes. */
    crosshair: Vec3;
    /** Labels that are not shown. */
    hidden: number[];
    /** Tetrahedron that is singled out, by its number from 0; -1: none. */
    element: number;
    /** Edges of the elements are drawn. */
    edges: boolean;
    /** How far labels are pulled apart; 1 doubles the distances of their middles. */
    explode: number;
    /** Time that is shown of a simulation; ms. */
    time_ms: number;
  };
}

/** The recipe before anybody has changed it. */
export const recipeDefaults = {
  "version": 2,
  "source": {
    "unit": "file",
    "precedence": [],
    "background": 0,
    "frame": -1
  },
  "legend": [],
  "labels": [],
  "merge": [],
  "volume": {
    "slice_ratio": 2,
    "speck_voxels": 0,
    "hole_voxels": 0,
    "handle_voxels": 0,
    "flat_border": true,
    "cut": [],
    "align_slices": false,
    "largest_shift_mm": 10,
    "slice_shifts": []
  },
  "surface": {
    "method": "auto"
  },
  "smooth": {
    "iterations": 50,
    "step": 0.4,
    "max_move_voxels": 0.5,
    "slice_share": 0,
    "keep_volume": true
  },
  "sizing": {
    "edge_mm": 2,
    "labels": [],
    "regions": [],
    "distances": [],
    "thickness": [],
    "masks": [],
    "images": [],
    "curvature": [],
    "waves": [],
    "edge_min_mm": 0.1,
    "edge_max_mm": 50,
    "gradation": 0.3
  },
  "remesh": {
    "method": "delaunay",
    "keep_topology": "all",
    "facet_angle_deg": 30,
    "max_distance_voxels": 0.5,
    "schedule": "adaptive",
    "shape_weight": 0.7,
    "verify": false
  },
  "tetra": {
    "backend": "delaunay",
    "radius_edge": 1.414,
    "min_dihedral_deg": 0,
    "max_dihedral_deg": 145
  },
  "optimise": {
    "rounds": 4,
    "min_dihedral_deg": 35,
    "insertion_deg": 33,
    "slide": 0.1
  },
  "transfer": {
    "labels": [],
    "samples_min": 4,
    "samples_max": 64
  },
  "quality": {
    "histogram_bins": 64,
    "sample_spacing_voxels": 0.25
  },
  "limits": {
    "tets": 0,
    "memory_mb": 0,
    "seconds": 0
  },
  "expected": {
    "engine": "",
    "digest": "",
    "tets": 0,
    "physics": "",
    "stages": {
      "eikonal": "",
      "monodomain": "",
      "mechanics": ""
    }
  }
} as const;

/** Groups that a recipe need not have, as they are at first. */
export const optionalDefaults = {
  "source.phantom": {
    "kind": "biventricle",
    "spacing_mm": [
      1.5,
      1.5,
      1.5
    ],
    "rotation_deg": [
      0,
      0,
      0
    ],
    "mirrored": false,
    "radius_mm": 20,
    "inner_radius_mm": 12,
    "thickness_mm": 8,
    "scale": 1,
    "roughness_mm": 0.8,
    "wall_scale": 1,
    "length_scale": 1,
    "rv_dilation": 1,
    "rv_wall_mm": 3.8,
    "blood_pools": true,
    "scar": false,
    "scar_angle_deg": 0,
    "scar_height_mm": 0,
    "scar_arc_mm": 48,
    "scar_length_mm": 40,
    "scar_depth": 0.7,
    "border_mm": 3,
    "isthmus_mm": 8,
    "regions": 300,
    "seed": 1
  },
  "source.inline": {
    "name": "",
    "data": ""
  },
  "source.file": {
    "name": "",
    "sha256": "",
    "url": ""
  },
  "source.threshold": {
    "lower": 0,
    "upper": 0
  },
  "physics": {
    "tissue": {
      "by": "mesh",
      "kinds": []
    },
    "stimuli": []
  },
  "physics.anatomy": {
    "wall": [],
    "lv_pool": [],
    "rv_pool": []
  },
  "physics.fibres": {
    "rule": "linear",
    "alpha_endo_deg": 60,
    "alpha_epi_deg": -60,
    "beta_endo_deg": -65,
    "beta_epi_deg": 25
  },
  "physics.fibres.septum": {
    "alpha_endo_deg": 60,
    "alpha_epi_deg": -60,
    "beta_endo_deg": -65,
    "beta_epi_deg": 25
  },
  "physics.monodomain": {
    "integration": "semi_implicit",
    "end_ms": 400,
    "step_ms": 0.05,
    "frame_ms": 5,
    "consistent_mass": 0.5,
    "correct_speed": false,
    "electrodes": []
  },
  "physics.mechanics": {
    "element": "p1_anp",
    "fine_fibres": false,
    "material": {},
    "labels": [],
    "bulk_kpa": 1000,
    "viscosity_kpa_s": 0.1,
    "density_kg_per_m3": 1000,
    "contraction": {
      "preset": "fast",
      "by": "eikonal",
      "start_ms": 150,
      "duration_ms": 250
    },
    "support": {
      "epicardium_kpa_per_mm": 0.01,
      "base_kpa_per_mm": 1,
      "damping_kpa_s_per_mm": 0.005
    },
    "windkessel": {
      "systemic": {
        "resistance_kpa_s_per_ml": 0.14,
        "compliance_ml_per_kpa": 11,
        "impedance_kpa_s_per_ml": 0.007,
        "venous_kpa": 0.7,
        "atrium_kpa": 1,
        "kick_kpa": 1.6,
        "kick_start_s": 0,
        "kick_s": 0.12
      },
      "pulmonary": {
        "resistance_kpa_s_per_ml": 0.02,
        "compliance_ml_per_kpa": 30,
        "impedance_kpa_s_per_ml": 0.003,
        "venous_kpa": 0.7,
        "atrium_kpa": 0.5,
        "kick_kpa": 0.9,
        "kick_start_s": 0,
        "kick_s": 0.12
      },
      "systemic_start_kpa": 10,
      "pulmonary_start_kpa": 2,
      "regurgitation": 0
    },
    "period_ms": 800,
    "beats": 5,
    "cycle_percent": 1,
    "fill_ms": 300,
    "step_ms": 5,
    "frame_ms": 10
  },
  "physics.mechanics.material.transversely_isotropic": {
    "c1_kpa": 3,
    "c2_kpa": 0.3,
    "a_f_kpa": 1.5,
    "b_f": 8
  },
  "physics.mechanics.material.holzapfel_ogden": {
    "a_kpa": 0.059,
    "b": 8.023,
    "a_f_kpa": 18.472,
    "b_f": 16.026,
    "a_s_kpa": 2.481,
    "b_s": 11.12,
    "a_fs_kpa": 0.216,
    "b_fs": 11.436,
    "k": 100
  },
  "physics.mechanics.material.guccione": {
    "c_kpa": 2,
    "b_f": 8,
    "b_t": 2,
    "b_fs": 4
  },
  "physics.mechanics.material.mooney_rivlin": {
    "c1_kpa": 1,
    "c2_kpa": 0
  },
  "physics.mechanics.material.corotational": {
    "shear_across_kpa": 6.6,
    "shear_along_kpa": 6.6,
    "fibre_kpa": 6
  },
  "physics.mechanics.contraction.lv": {
    "peak_kpa": 80,
    "rise_per_s": 25,
    "fall_per_s": 20,
    "switch_ms": 0
  },
  "physics.mechanics.contraction.rv": {
    "peak_kpa": 80,
    "rise_per_s": 25,
    "fall_per_s": 20,
    "switch_ms": 0
  },
  "physics.mechanics.closed_loop": {
    "left_atrium": {
      "active_kpa_per_ml": 0.00933256711905,
      "passive_kpa_per_ml": 0.0239980297347,
      "unloaded_ml": 4,
      "start_s": 0,
      "contraction_s": 0.17,
      "relaxation_s": 0.17
    },
    "right_atrium": {
      "active_kpa_per_ml": 0.007999343244899999,
      "passive_kpa_per_ml": 0.00933256711905,
      "unloaded_ml": 4,
      "start_s": 0,
      "contraction_s": 0.17,
      "relaxation_s": 0.17
    },
    "systemic_arteries": {
      "resistance_kpa_s_per_ml": 0.09772530997519499,
      "compliance_ml_per_kpa": 10.290844820602405,
      "inertance_kpa_s2_per_ml": 0.000666611937075
    },
    "systemic_veins": {
      "resistance_kpa_s_per_ml": 0.0426631639728,
      "compliance_ml_per_kpa": 85.22949686334194,
      "inertance_kpa_s2_per_ml": 0.0000666611937075
    },
    "pulmonary_arteries": {
      "resistance_kpa_s_per_ml": 0.006132829821089999,
      "compliance_ml_per_kpa": 150.01231516913128,
      "inertance_kpa_s2_per_ml": 0.0000666611937075
    },
    "pulmonary_veins": {
      "resistance_kpa_s_per_ml": 0.0001999835811225,
      "compliance_ml_per_kpa": 120.00985213530502,
      "inertance_kpa_s2_per_ml": 0.0000666611937075
    },
    "regurgitation": 0
  },
  "physics.diffusion": {
    "from": 1,
    "diffusivity_mm2_per_ms": 1,
    "end_ms": 100,
    "step_ms": 1,
    "frame_ms": 5
  },
  "view": {
    "stage": "",
    "colour": "",
    "layout": "model",
    "crosshair": [
      0.5,
      0.5,
      0.5
    ],
    "hidden": [],
    "element": -1,
    "edges": true,
    "explode": 0,
    "time_ms": 0
  },
  "view.camera": {
    "position_mm": [
      0,
      0,
      0
    ],
    "target_mm": [
      0,
      0,
      0
    ]
  },
  "view.cut": {
    "normal": [
      0,
      1,
      0
    ],
    "place": 0.5,
    "flat": false
  }
} as const;

/** What each stage is made from: stages before it, and fields of the recipe. */
export const stageSpecs = [
  {
    "name": "volume",
    "inputs": [],
    "reads": [
      "source.phantom",
      "source.inline",
      "source.unit",
      "source.precedence",
      "source.background",
      "source.frame",
      "source.threshold",
      "labels",
      "merge",
      "volume"
    ]
  },
  {
    "name": "surface",
    "inputs": [
      "volume"
    ],
    "reads": [
      "surface"
    ]
  },
  {
    "name": "smooth",
    "inputs": [
      "volume",
      "surface"
    ],
    "reads": [
      "smooth"
    ]
  },
  {
    "name": "walls",
    "inputs": [
      "volume",
      "smooth"
    ],
    "reads": [
      "sizing.thickness[].wall",
      "sizing.thickness[].inner",
      "sizing.thickness[].layering"
    ]
  },
  {
    "name": "sizing",
    "inputs": [
      "volume",
      "smooth",
      "walls"
    ],
    "reads": [
      "sizing"
    ]
  },
  {
    "name": "layers",
    "inputs": [
      "volume",
      "walls"
    ],
    "reads": [
      "sizing.thickness[].layers",
      "sizing.thickness[].layering"
    ]
  },
  {
    "name": "remesh",
    "inputs": [
      "volume",
      "smooth",
      "sizing",
      "layers"
    ],
    "reads": [
      "remesh"
    ]
  },
  {
    "name": "tetra",
    "inputs": [
      "volume",
      "sizing",
      "layers",
      "remesh"
    ],
    "reads": [
      "tetra"
    ]
  },
  {
    "name": "optimise",
    "inputs": [
      "volume",
      "smooth",
      "sizing",
      "layers",
      "remesh",
      "tetra"
    ],
    "reads": [
      "optimise"
    ]
  },
  {
    "name": "transfer",
    "inputs": [
      "volume",
      "optimise"
    ],
    "reads": [
      "transfer"
    ]
  },
  {
    "name": "quality",
    "inputs": [
      "volume",
      "smooth",
      "walls",
      "sizing",
      "remesh",
      "optimise",
      "transfer"
    ],
    "reads": [
      "quality"
    ]
  },
  {
    "name": "anatomy",
    "inputs": [
      "volume",
      "optimise"
    ],
    "reads": [
      "physics.anatomy"
    ]
  },
  {
    "name": "fibres",
    "inputs": [
      "optimise",
      "anatomy"
    ],
    "reads": [
      "physics.fibres"
    ]
  },
  {
    "name": "tissue",
    "inputs": [
      "optimise",
      "transfer",
      "fibres"
    ],
    "reads": [
      "physics.tissue",
      "physics.monodomain.integration",
      "physics.monodomain.consistent_mass",
      "physics.monodomain.correct_speed"
    ]
  },
  {
    "name": "eikonal",
    "inputs": [
      "optimise",
      "tissue"
    ],
    "reads": [
      "physics.stimuli"
    ]
  },
  {
    "name": "monodomain",
    "inputs": [
      "optimise",
      "tissue"
    ],
    "reads": [
      "physics.stimuli",
      "physics.monodomain"
    ]
  },
  {
    "name": "diffusion",
    "inputs": [
      "optimise"
    ],
    "reads": [
      "physics.diffusion"
    ]
  },
  {
    "name": "mechanics",
    "inputs": [
      "optimise",
      "anatomy",
      "fibres",
      "eikonal",
      "monodomain"
    ],
    "reads": [
      "physics.mechanics"
    ]
  }
] as const;

/** The stages that the app shows; the others run by themselves before those that need them. */
export const stageNames = [
  "volume",
  "surface",
  "smooth",
  "sizing",
  "remesh",
  "optimise",
  "quality"
] as const;
