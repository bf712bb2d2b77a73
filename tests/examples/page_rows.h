// Figures in the tables of examples' pages, and what a report says of the same.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/bytes/files.h"

namespace voxtet::test {

inline std::string text_of(const std::string& page) {
  const Result<Bytes> bytes = read_file(std::string(VOXTET_SOURCE_DIR) + "/examples/" + page);
  return bytes ? std::string(bytes->begin(), bytes->end()) : std::string();
}

using Cells = std::vector<std::string>;

/// The cells of every row of the page's tables.
inline std::vector<Cells> rows_of(const std::string& page) {
  std::vector<Cells> rows;
  std::istringstream lines(text_of(page));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| ")) continue;
    Cells& cells = rows.emplace_back();
    std::istringstream words(line.substr(1));
    for (std::string cell; std::getline(words, cell, '|');)
      cells.push_back(cell.size() > 2 ? cell.substr(1, cell.size() - 2) : "");
  }
  return rows;
}

/// The row whose first cell is `name`; no cells where there is none.
inline Cells row_of(const std::string& page, const std::string& name) {
  for (const Cells& cells : rows_of(page))
    if (cells[0] == name) return cells;
  return {};
}

/// A number as a page writes it, and half of its last digit.
struct Figure {
  double value, half;
};

/// "+0.02 % / −1,234 mm" -> 0.02, -1234
inline std::vector<Figure> figures_of(std::string cell) {
  const std::string minus = "−";
  for (std::size_t at; (at = cell.find(minus)) != std::string::npos;) cell.replace(at, minus.size(), "-");
  std::erase(cell, ',');
  std::vector<Figure> figures;
  const char* digits = "0123456789";
  for (std::size_t at = 0; (at = cell.find_first_of(digits, at)) != std::string::npos;) {
    const std::size_t end = cell.find_first_not_of("0123456789.", at);
    const std::string number = cell.substr(at, end == std::string::npos ? end : end - at);
    const std::size_t point = number.find('.');
    const auto decimals = point == std::string::npos ? 0 : static_cast<int>(number.size() - point) - 1;
    const double sign = at > 0 && cell[at - 1] == '-' ? -1 : 1;
    figures.push_back({sign * std::atof(number.c_str()), 0.5 * std::pow(10.0, -decimals)});
    at = end;
    if (end == std::string::npos) break;
  }
  return figures;
}

/// Every number of the cell is the rounded value.
inline void expect_figures(const std::string& cell, const std::vector<double>& values,
                           const std::string& what) {
  constexpr double kRounding = 1.001;
  const std::vector<Figure> figures = figures_of(cell);
  ASSERT_EQ(figures.size(), values.size()) << what << ": " << cell;
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(figures[i].value, values[i], kRounding * figures[i].half) << what << ": " << cell;
}

/// The metric of a report's quality.
inline const nlohmann::json& metric_of(const nlohmann::json& report, const std::string& name) {
  for (const nlohmann::json& metric : report["quality"]["metrics"])
    if (metric["name"] == name) return metric;
  throw std::out_of_range("no metric " + name);
}

/// The rows of a page that tell of its mesh, those that `scripts/update_expected` knows, against the report.
inline void expect_mesh_rows(const std::string& page, const nlohmann::json& report) {
  const auto by_label = [&](const char* field) {
    std::vector<double> values;
    for (const nlohmann::json& label : report["fidelity"]["labels"]) values.push_back(label[field]);
    return values;
  };
  const auto of = [](const nlohmann::json& from, std::initializer_list<const char*> fields) {
    std::vector<double> values;
    for (const char* field : fields) values.push_back(from[field]);
    return values;
  };
  for (const Cells& cells : rows_of(page)) {
    if (cells.size() < 2) continue;
    const std::string& name = cells[0];
    std::vector<double> values;
    if (name == "tetrahedra" && cells.size() == 2)
      values = of(report, {"tets"});
    else if (name.starts_with("Dice, label"))
      values = by_label("dice");
    else if (name.starts_with("volume error, label"))
      values = by_label("volume_error_percent");
    else if (name.starts_with("median edge, label"))
      values = by_label("median_edge_mm");
    else if (name == "distance mesh → label surface, mean / max")
      values = of(report["fidelity"]["mesh_to_surface"], {"mean_mm", "max_mm"});
    else if (name == "smallest dihedral angle, 1 % quantile")
      values = of(metric_of(report, "min_dihedral_deg"), {"min", "p1"});
    else if (name == "smallest angle of the surface's triangles")
      values = of(metric_of(report, "triangle_min_angle_deg"), {"min"});
    else
      continue;
    expect_figures(cells[1], values, page + ": " + name);
  }
}

}  // namespace voxtet::test
