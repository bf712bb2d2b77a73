#include "study/page/page.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <map>
#include <optional>
#include <string_view>

#include "base/with_commas.h"
#include "io/bytes/xml_escaped.h"
#include "pipeline/version/engine_version.h"
#include "study/page/outliers.h"
#include "study/page/plot.h"

namespace voxtet {
namespace {

using Json = nlohmann::ordered_json;

/// A figure that is drawn, and how people call it.
struct Shown {
  std::string_view column;
  const char* title;
};
constexpr std::array<Shown, 10> kShown{{{"tets", "Tetrahedra"},
                                        {"smallest_dihedral_deg", "Smallest dihedral angle, degrees"},
                                        {"median_mean_ratio", "Median mean ratio"},
                                        {"mean_distance_mm", "Mean distance to the labels, mm"},
                                        {"largest_distance_mm", "Largest distance to the labels, mm"},
                                        {"worst_volume_error_percent", "Worst error of a label's volume, %"},
                                        {"least_dice", "Least Dice overlap of a label"},
                                        {"eikonal_last_ms", "Last activation, ms"},
                                        {"monodomain_last_ms", "Last activation of the monodomain model, ms"},
                                        {"lv_ejection_fraction", "Ejection fraction of the left ventricle"}}};

constexpr const char* kStyle = R"(
body{font:15px/1.5 system-ui,sans-serif;color:#1c2733;max-width:1100px;margin:2rem auto;padding:0 1rem}
h1{font-size:1.6rem;margin:0}h2{font-size:1.15rem;margin:2rem 0 .5rem}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(320px,1fr));gap:1rem}
.plot text{font:10px system-ui,sans-serif;fill:#475569}.plot path{stroke:#e2e8f0}
.plot .diagonal{stroke:#94a3b8;stroke-dasharray:4 3}
.plot rect{fill:#1d6fa5}.plot circle{fill:#1d6fa5;fill-opacity:.65;stroke:#fff;stroke-width:.6}
.plot circle.marked{fill:#c2410c;fill-opacity:1}
figure{margin:0;border:1px solid #e2e8f0;border-radius:6px;padding:.6rem}figure img{width:100%;height:auto}
figcaption{font-size:.85rem}table{border-collapse:collapse;font-size:.85rem;font-variant-numeric:tabular-nums}
th,td{padding:.2rem .6rem;border-bottom:1px solid #e2e8f0;text-align:right;white-space:nowrap}
th:nth-child(2),th.reason{text-align:left}
th{position:sticky;top:0;background:#fff}td:nth-child(2),td.reason{text-align:left}td.reason{white-space:normal}
.wide{overflow-x:auto;max-height:70vh}a{color:#0b5c8f}.failed{color:#b91c1c}
@media print{.wide{overflow:visible;max-height:none}})";

std::string link_of(const Json& row, const std::string& base) {
  return "<a href=\"" + xml_escaped(base + row["link"].get<std::string>()) + "\">" +
         xml_escaped(row["name"].get<std::string>()) + "</a>";
}

std::string cell_text(const Json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value;
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (value.is_number_unsigned()) return with_commas(value.get<std::uint64_t>());
  if (!value.is_number()) return value.dump();
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value.get<double>());
  return text;
}

std::string summary(const StudyTable& table) {
  const auto unsound =
      static_cast<std::size_t>(std::count_if(table.rows.begin(), table.rows.end(), [](const Json& row) {
        return row.value("passed", Json()) == false;
      }));
  const std::size_t done = count_of(table.rows, "done"), failed = count_of(table.rows, "failed"),
                    missing = count_of(table.rows, "missing");
  std::string out = "<p>" + with_commas(table.rows.size()) + " cases: " + with_commas(done) + " done, " +
                    with_commas(failed) + " failed, " + with_commas(missing) + " not run" +
                    (unsound > 0 ? "; " + with_commas(unsound) + " of the meshes fail a hard check. " : ". ");
  double seconds = 0, most_mb = 0;
  for (const Json& cost : table.costs) {
    if (cost["seconds"].is_number()) seconds += cost["seconds"].get<double>();
    if (cost["peak_mb"].is_number()) most_mb = std::max(most_mb, cost["peak_mb"].get<double>());
  }
  return out + cell_text(seconds) + " s in all, at most " + cell_text(most_mb) + " MB a case. Engine " +
         xml_escaped(engine_version()) + ". The same table: <a href=\"table.csv\">table.csv</a>, " +
         "<a href=\"table.jsonl\">table.jsonl</a>, which the app opens; times and memory: <a "
         "href=\"costs.csv\">costs.csv</a>.</p>";
}

std::string failures(const StudyTable& table, const std::string& base) {
  std::string rows;
  for (const Json& row : table.rows)
    if (row["status"] == "failed")
      rows += "<tr><td>" + cell_text(row["case"]) + "</td><td>" + link_of(row, base) + "</td><td>" +
              xml_escaped(cell_text(row["stage"])) + "</td><td class=\"reason failed\">" +
              xml_escaped(cell_text(row["reason"])) + "</td></tr>";
  if (rows.empty()) return "";
  return "<h2>Failures</h2><div "
         "class=\"wide\"><table><tr><th>case</th><th>name</th><th>stage</th><th "
         "class=\"reason\">reason</th></tr>" +
         rows + "</table></div>";
}

/// Two columns against each other, the rows with both. Nothing where there are fewer than two.
std::string scatter(const std::vector<Json>& rows, const std::vector<Json>& x_rows,
                    const std::vector<Json>& y_rows, const Shown& x, const Shown& y,
                    const std::vector<bool>& marked, bool diagonal) {
  const std::vector<std::optional<double>> xs = numbers_of(x_rows, std::string(x.column)),
                                           ys = numbers_of(y_rows, std::string(y.column));
  std::vector<PlotPoint> points;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (xs[i] && ys[i])
      points.push_back(
          {*xs[i], *ys[i],
           rows[i]["name"].get<std::string>() + ": " + cell_text(*xs[i]) + ", " + cell_text(*ys[i]),
           marked[i]});
  return points.size() < 2 ? "" : scatter_svg(std::string(y.title), x.title, "", points, diagonal);
}

std::string distributions(const StudyTable& table) {
  std::string out;
  for (const Shown& shown : kShown) {
    std::vector<double> values;
    for (const std::optional<double>& number : numbers_of(table.rows, std::string(shown.column)))
      if (number) values.push_back(*number);
    if (values.size() > 1) out += histogram_svg(shown.title, values);
  }
  return out.empty() ? "" : "<h2>Distributions</h2><div class=\"grid\">" + out + "</div>";
}

std::string against_cost(const StudyTable& table, const std::vector<bool>& marked) {
  const Shown tets{"tets", "tetrahedra"};
  std::string out;
  for (const Shown& shown : kShown)
    if (shown.column != tets.column)
      out += scatter(table.rows, table.rows, table.rows, tets, shown, marked, false);
  out += scatter(table.rows, table.rows, table.costs, tets, {"seconds", "Time, s"}, marked, false);
  out += scatter(table.rows, table.costs, table.costs, {"forecast_seconds", "forecast, s, meshing alone"},
                 {"seconds", "Time, s"}, marked, true);
  out += scatter(table.rows, table.costs, table.costs, {"forecast_mb", "forecast, MB"},
                 {"peak_mb", "Memory, MB"}, marked, true);
  return out.empty() ? "" : "<h2>Against cost and forecast</h2><div class=\"grid\">" + out + "</div>";
}

std::string outlier_figures(const StudyTable& table, const std::vector<Outlier>& outliers,
                            const std::string& base) {
  constexpr std::size_t kMost = 12;
  std::vector<std::size_t> order;
  std::map<std::size_t, std::string> lines;
  for (const Outlier& outlier : outliers) {
    if (!lines.contains(outlier.row)) order.push_back(outlier.row);
    const auto shown = std::find_if(kShown.begin(), kShown.end(),
                                    [&](const Shown& s) { return s.column == outlier.column; });
    lines[outlier.row] += "<br>" + xml_escaped(shown->title) + ": " + cell_text(outlier.value) + " (median " +
                          cell_text(outlier.median) + ")";
  }
  if (order.empty()) return "";
  std::string out =
      "<h2>Outliers</h2><p>" + std::to_string(order.size()) +
      " of the cases have a figure that is farther from the quartiles of its column than three times the "
      "distance between them" +
      (order.size() > kMost ? "; the farthest " + std::to_string(kMost) : "") + ":</p><div class=\"grid\">";
  for (std::size_t i = 0; i < std::min(kMost, order.size()); ++i) {
    const Json& row = table.rows[order[i]];
    out += "<figure><img width=\"320\" height=\"240\" alt=\"\" src=\"pictures/" +
           row["key"].get<std::string>() + ".png\"><figcaption>" + link_of(row, base) + lines[order[i]] +
           "</figcaption></figure>";
  }
  return out + "</div>";
}

std::string whole_table(const StudyTable& table, const std::string& base) {
  const auto left_out = [](const std::string& column) {
    return column == "key" || column == "link" || column == "stage" || column == "reason" ||
           column.ends_with("_digest");
  };
  // Columns that no case has are of stages that were not asked for.
  const auto is_empty = [&](const std::string& column) {
    return std::all_of(table.rows.begin(), table.rows.end(),
                       [&](const Json& row) { return row[column].is_null(); });
  };
  std::vector<std::string> columns;
  std::string out = "<h2>All cases</h2><div class=\"wide\"><table><tr>";
  for (const auto& [column, value] : table.rows.front().items()) {
    if (left_out(column) || is_empty(column)) continue;
    columns.push_back(column);
    out += "<th title=\"" + xml_escaped(column) + "\">" + xml_escaped(column.substr(column.rfind('.') + 1)) +
           "</th>";
  }
  out += "</tr>";
  for (const Json& row : table.rows) {
    out += "<tr>";
    for (const std::string& column : columns)
      out += "<td>" + (column == "name" ? link_of(row, base) : xml_escaped(cell_text(row[column]))) + "</td>";
    out += "</tr>\n";
  }
  return out + "</table></div>";
}

}  // namespace

std::string study_page(const Study& study, const StudyTable& table, const std::string& base) {
  std::vector<std::string> judged;
  judged.reserve(kShown.size());
  for (const Shown& shown : kShown) judged.emplace_back(shown.column);
  const std::vector<Outlier> outliers = find_outliers(table.rows, judged);
  std::vector<bool> marked(table.rows.size());
  for (const Outlier& outlier : outliers) marked[outlier.row] = true;
  return "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width\"><title>" +
         xml_escaped(study.title) + "</title><style>" + kStyle + "</style>\n<h1>" + xml_escaped(study.title) +
         "</h1>\n" + summary(table) + failures(table, base) + distributions(table) +
         against_cost(table, marked) + outlier_figures(table, outliers, base) + whole_table(table, base) +
         "</html>\n";
}

}  // namespace voxtet
