#include "io/mesh/write_carp_case.h"

#include <cmath>
#include <string_view>

#include "io/bytes/byte_writer.h"

namespace voxtet {
namespace {

/// Where openCARP puts its results, and what it calls its first activations (num_LATs, lats[0].ID).
constexpr std::string_view kResults = "opencarp", kActivations = "init_acts_activation-thresh.dat";

/// The lines of a parameter file.
class ParFile {
 public:
  void comment(const std::string& text) { out_.text("# " + text + "\n"); }
  void heading(const std::string& text) { out_.text("\n# " + text + "\n"); }
  void set(const std::string& key, std::int64_t value) {
    begin(key);
    out_.integer(value);
    out_.text("\n");
  }
  void set_real(const std::string& key, double value) {
    begin(key);
    out_.real(value);
    out_.text("\n");
  }
  void set_text(const std::string& key, const std::string& value) {
    begin(key);
    out_.text("\"" + value + "\"\n");
  }
  Bytes take() { return out_.take(); }

 private:
  void begin(const std::string& key) { out_.text(key + " = "); }
  ByteWriter out_{4096};
};

std::string par_number(double value) {
  char text[kRealChars];
  return {text, format_real(text, value)};
}

std::string par_entry(const char* list, std::size_t index, const char* field) {
  return std::string(list) + "[" + std::to_string(index) + "]." + field;
}

/// Characters that could end a quoted text are left out.
std::string without_quotes(const std::string& name) {
  std::string out;
  for (const char c : name)
    if (c >= ' ' && c != '"' && c != '#') out += c;
  return out;
}

std::string vtx_suffix(std::size_t electrode) {
  return ".stim" + std::to_string(electrode) + ".vtx";
}

void write_regions(ParFile& par, const char* list, std::size_t index, const std::vector<Label>& regions) {
  par.set(par_entry(list, index, "num_IDs"), static_cast<std::int64_t>(regions.size()));
  for (std::size_t i = 0; i < regions.size(); ++i)
    par.set(par_entry(list, index, "ID[") + std::to_string(i) + "]", regions[i]);
}

/// Names as in public cases of the model for openCARP; the modified one's inward current turns at its gate.
std::string cell_text(const CellParams& cell, const CarpCase& simulation) {
  return "V_gate=" + par_number(cell.gate) + ",a_crit=" + par_number(cell.modified ? cell.gate : 0) +
         ",tau_in=" + par_number(cell.tau_in_ms) + ",tau_out=" + par_number(cell.tau_out_ms) +
         ",tau_open=" + par_number(cell.tau_open_ms) + ",tau_close=" + par_number(cell.tau_close_ms) +
         ",V_min=" + par_number(simulation.rest_mv) + ",V_max=" + par_number(simulation.peak_mv);
}

void write_par_head(ParFile& par, const CarpCase& simulation, const std::string& name) {
  par.comment("openCARP: openCARP +F " + name + ".par, in the folder of this file.");
  par.comment("Names of parameters as in https://opencarp.org/parameters; of im_param as in");
  par.comment("bench --imp=MitchellSchaeffer --imp-info.");
  for (const std::string& note : simulation.notes) par.comment(note);
  par.comment("Activation to be expected at the points that conduct: " + name +
              ".expected_ms.dat, -1 for none.");
  par.comment("To compare, the number of points activated in both and the root mean square difference, ms:");
  par.comment("paste " + name + ".expected_ms.dat " + std::string(kResults) + "/" +
              std::string(kActivations) + " |");
  par.comment("  awk '$1 >= 0 && $2 >= 0 {d = $2 - $1; s += d * d; n++} END {print n, sqrt(s / n)}'");
}

void write_numerics(ParFile& par, const CarpCase& simulation, const std::string& name) {
  par.heading("Mesh, model and times: dt in us, the others in ms.");
  par.set_text("meshname", name);
  par.set_text("simID", std::string(kResults));
  par.set("bidomain", 0);
  par.set("parab_solve", 1);
  par.set("mass_lumping", simulation.lumped ? 1 : 0);
  par.set_real("dt", 1000 * simulation.step_ms);
  par.set_real("tend", simulation.end_ms);
  par.set_real("spacedt", simulation.frame_ms);
  par.set_real("timedt", simulation.frame_ms);
  par.comment("The mesh of the results, which has only the points that conduct.");
  par.set("gridout_i", 3);
}

void write_tissues(ParFile& par, const CarpCase& simulation, const std::string& name) {
  std::vector<Label> conducting;
  for (const CarpCase::Tissue& tissue : simulation.tissues)
    conducting.insert(conducting.end(), tissue.regions.begin(), tissue.regions.end());
  par.heading("Regions that conduct; those of .elem that are not listed are left out.");
  par.set("num_phys_regions", 1);
  par.set_text("phys_region[0].name", "Intracellular domain");
  par.set("phys_region[0].ptype", 0);
  write_regions(par, "phys_region", 0, conducting);

  par.heading(
      "Conductivities in S/m. Without the equivalent of a bidomain (bidm_eqv_mono) they are those of");
  par.comment("the monodomain model: D = g / (cellSurfVolRatio Cm), Cm = 1 uF/cm^2; 1 mm^2/ms is 1.4 S/m.");
  par.set("bidm_eqv_mono", 0);
  par.set("num_gregions", static_cast<std::int64_t>(simulation.tissues.size()));
  for (std::size_t i = 0; i < simulation.tissues.size(); ++i) {
    const CarpCase::Tissue& tissue = simulation.tissues[i];
    write_regions(par, "gregion", i, tissue.regions);
    par.set_real(par_entry("gregion", i, "g_il"), tissue.along_s_per_m);
    par.set_real(par_entry("gregion", i, "g_it"), tissue.across_s_per_m);
    par.set_real(par_entry("gregion", i, "g_in"), tissue.across_s_per_m);
  }
  if (!simulation.conductivity_factors.empty()) {
    par.comment("Factors of these, one for each element.");
    par.set_text("gi_scale_vec", name + ".gi_scale.dat");
  }

  par.heading("Cells; v is 0 at V_min, 1 at V_max. With a_crit = 0 those of Mitchell and Schaeffer (2003):");
  par.comment("  dv/dt = w v^2 (1 - v) / tau_in - v / tau_out");
  par.comment("With a_crit > 0 those of Corrado and Niederer (2016):");
  par.comment("  dv/dt = w v (v - a_crit) (1 - v) / tau_in - (1 - w) v / tau_out");
  par.set("num_imp_regions", static_cast<std::int64_t>(simulation.tissues.size()));
  for (std::size_t i = 0; i < simulation.tissues.size(); ++i) {
    const CarpCase::Tissue& tissue = simulation.tissues[i];
    par.set_text(par_entry("imp_region", i, "im"), "MitchellSchaeffer");
    par.set_text(par_entry("imp_region", i, "im_param"), cell_text(tissue.cell, simulation));
    par.set_real(par_entry("imp_region", i, "cellSurfVolRatio"), kSurfacePerUm);
    write_regions(par, "imp_region", i, tissue.regions);
  }
}

void write_currents(ParFile& par, const CarpCase& simulation, const std::string& name) {
  par.heading("Transmembrane currents, uA/cm^2.");
  par.set("num_stim", static_cast<std::int64_t>(simulation.currents.size()));
  for (std::size_t i = 0; i < simulation.currents.size(); ++i) {
    const CarpCase::Current& current = simulation.currents[i];
    par.set_text(par_entry("stim", i, "name"), without_quotes(current.name));
    par.set(par_entry("stim", i, "crct.type"), 0);
    par.set_text(par_entry("stim", i, "elec.vtx_file"), name + vtx_suffix(current.electrode));
    par.set_real(par_entry("stim", i, "pulse.strength"), current.strength_ua_per_cm2);
    par.set_real(par_entry("stim", i, "ptcl.start"), current.start_ms);
    par.set_real(par_entry("stim", i, "ptcl.duration"), current.duration_ms);
    par.set(par_entry("stim", i, "ptcl.npls"), current.count);
    if (current.count > 1) par.set_real(par_entry("stim", i, "ptcl.bcl"), current.interval_ms);
  }
  par.heading("The first time at which each point's voltage (mV) rises through the threshold.");
  par.set("num_LATs", 1);
  par.set_text("lats[0].ID", "activation");
  par.set("lats[0].measurand", 0);
  par.set("lats[0].all", 0);
  par.set("lats[0].mode", 0);
  par.set("lats[0].method", 1);
  par.set_real("lats[0].threshold", simulation.activated_mv);
}

/// "intra": points of the tissue, numbered as in .pts.
Bytes write_electrode(const std::vector<std::uint32_t>& points) {
  ByteWriter out(12 * points.size() + 64);
  out.text(std::to_string(points.size()) + "\nintra\n");
  for (const std::uint32_t point : points) {
    out.integer(point);
    out.text("\n");
  }
  return out.take();
}

Bytes write_column(std::string_view head, const std::vector<float>& values) {
  ByteWriter out(12 * values.size() + 64);
  out.text(head);
  for (const float value : values) {
    out.real(std::isnan(value) ? -1 : value);
    out.text("\n");
  }
  return out.take();
}

}  // namespace

std::vector<OutputFile> write_carp_case(const CarpCase& simulation, const std::string& name) {
  ParFile par;
  write_par_head(par, simulation, name);
  write_numerics(par, simulation, name);
  write_tissues(par, simulation, name);
  write_currents(par, simulation, name);
  std::vector<OutputFile> files{{".par", par.take()},
                                {".expected_ms.dat", write_column("", simulation.expected_ms)}};
  for (std::size_t i = 0; i < simulation.electrodes.size(); ++i)
    files.push_back({vtx_suffix(i), write_electrode(simulation.electrodes[i])});
  if (!simulation.conductivity_factors.empty())
    files.push_back({".gi_scale.dat", write_column("1\n", simulation.conductivity_factors)});
  return files;
}

}  // namespace voxtet
