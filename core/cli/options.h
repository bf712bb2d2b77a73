// What the commands share: options, and what is done with results.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/input/case_input.h"
#include "io/mesh/write_mesh.h"
#include "pipeline/session.h"
#include "types/result.h"
#include "types/run_context.h"
#include "types/tet_mesh.h"

namespace voxtet {

/// Where results go.
struct Output {
  bool as_json = false;
  double time_limit_s = 0;
  int threads = 0;          ///< 0: as many as the machine has cores
  std::string mesh_format;  ///< of a mesh on standard output, as "vtu"
  std::string lps_or_ras = "ras";
  std::string msh_version;     ///< "2.2" or "4.1"; empty: 4.1
  bool stl_per_label = false;  ///< an .stl for each label instead of one
  int order = 1;               ///< of the elements: 2 for tetrahedra of ten nodes
  PatientSpace space() const { return lps_or_ras == "lps" ? PatientSpace::kLps : PatientSpace::kRas; }
};

/// Whether a file of this name would be NIfTI.
bool is_nifti_name(const std::string& path);

/// Refuses an empty text: what is left of a shell's variable that is not set.
extern const CLI::Validator kNotEmpty;

/// The help of --label-array.
inline constexpr const char* kLabelArrayHelp =
    "the cell array of .vtu, .vtk, .xdmf that holds the labels, in the place of label; of .msh gmsh:physical "
    "or "
    "gmsh:geometrical";

/// The options of commands that open a case.
void add_case_options(CLI::App& command, CaseOptions& options, Output& output, const std::string& input_name);

/// JSON as text. Names that are not UTF-8, as files may have, lose the bytes that JSON cannot hold.
std::string text_of(const nlohmann::json& value);
void print_json(const nlohmann::json& value);

/// A context that prints its progress and ends with the time limit, which begins now.
RunContext context_of(const Output& output);

/// Prints the error, with --json also as an object on standard output, and returns its exit code.
int fail(const Error& error, const Output& output);

/// The error of a run; nothing but the time limit cancels one.
Error run_error(Error error, const Output& output);

/// Prints why a run ended, and returns its exit code.
int fail_run(Error error, const Output& output);

/// The options of how a mesh file is written: --space, --msh, --stl-per-label, --order.
void add_write_options(CLI::App& command, Output& output);

/// The format of a mesh file, by its ending and these options. Errors: kUsage for an unknown ending, and for
/// an option of another format.
Result<MeshFormat> written_format(const std::string& path, const Output& output);

/// The path of a mesh file, by whose ending its format is known; for "-" a name with the ending that
/// --output-format says. Errors: kUsage where that is missing, or given for a path, or makes several files.
Result<std::string> mesh_path_of(const std::string& path, const Output& output);

/// Writes a mesh with its data, in the space of `output`, and returns the exit code. Second-order elements
/// are those of options.midside, else they have straight edges.
int export_mesh(const TetMesh& mesh, WriteMeshOptions options, const std::string& path, const Output& output);
/// The same for the mesh of a session and what goes with it (exported_fields.h).
int export_session(const Session& session, bool measures, const std::string& path, const Output& output);

}  // namespace voxtet
