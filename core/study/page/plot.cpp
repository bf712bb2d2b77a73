#include "study/page/plot.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>

#include <cstdio>

#include "io/bytes/xml_escaped.h"

namespace voxtet {
namespace {

constexpr double kLeft = 58, kTop = 30, kWide = 280, kTall = 170;

[[gnu::format(printf, 1, 2)]] std::string format(const char* form, ...) {
  char text[256];
  std::va_list values;
  va_start(values, form);
  std::vsnprintf(text, sizeof text, form, values);
  va_end(values);
  return text;
}

std::string number(double value) {
  return format("%.6g", value);
}

/// The numbers at the ticks of an axis, in thousands where the last has five digits.
std::string tick_text(double tick, const std::vector<double>& ticks) {
  const double most = std::max(std::abs(ticks.front()), std::abs(ticks.back()));
  return most < 1e4 || tick == 0 ? number(tick) : number(tick / 1000) + "k";
}

std::string words(double x, double y, const char* anchor, const std::string& text) {
  return format("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor) + xml_escaped(text) +
         "</text>";
}

/// Axes and their place for the values between the first and last tick.
class Axes {
 public:
  Axes(std::vector<double> x_ticks, std::vector<double> y_ticks)
      : x_ticks_(std::move(x_ticks)), y_ticks_(std::move(y_ticks)) {}
  double x(double value) const {
    return kLeft + kWide * (value - x_ticks_.front()) / (x_ticks_.back() - x_ticks_.front());
  }
  double y(double value) const {
    return kTop + kTall * (1 - (value - y_ticks_.front()) / (y_ticks_.back() - y_ticks_.front()));
  }

  std::string frame(const std::string& title, const std::string& x_title, const std::string& y_title) const {
    std::string out = format("<svg class=\"plot\" viewBox=\"0 0 %.0f %.0f\" role=\"img\">",
                             kLeft + kWide + 16, kTop + kTall + 42);
    out += "<title>" + xml_escaped(title) + "</title>" + words(kLeft, 14, "start", title);
    for (const double tick : x_ticks_)
      out += format("<path d=\"M%.1f %.1fv%.1f\"/>", x(tick), kTop, kTall) +
             words(x(tick), kTop + kTall + 14, "middle", tick_text(tick, x_ticks_));
    for (const double tick : y_ticks_)
      out += format("<path d=\"M%.1f %.1fh%.1f\"/>", kLeft, y(tick), kWide) +
             words(kLeft - 6, y(tick) + 4, "end", tick_text(tick, y_ticks_));
    out += words(kLeft + kWide / 2, kTop + kTall + 32, "middle", x_title);
    return out + words(kLeft - 50, kTop - 8, "start", y_title);
  }

 private:
  std::vector<double> x_ticks_, y_ticks_;
};

}  // namespace

std::vector<double> round_ticks(double low, double high, double least) {
  constexpr double kFewest = 2;
  // Closer values could not be told apart by the numbers at the ticks.
  constexpr double kLeastRange = 1e-4;
  if (!(high - low > kLeastRange * std::max(std::abs(low), std::abs(high)))) {
    const double margin = low != 0 ? 0.5 * std::abs(low) : 1;
    low -= margin;
    high += margin;
  }
  const double power = std::pow(10, std::floor(std::log10((high - low) / kFewest)));
  double step = power;
  for (const double larger : {2 * power, 5 * power})
    if ((high - low) / larger >= kFewest) step = larger;
  step = std::max(step, least);
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  std::vector<double> ticks;
  for (double i = first; i <= last; ++i) ticks.push_back(i * step);
  return ticks;
}

std::string histogram_svg(const std::string& title, const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const std::vector<double> ticks = round_ticks(*low, *high);
  // Bars end at ticks or halfway between them.
  const std::size_t bars = 2 * (ticks.size() - 1);
  const double width = (ticks.back() - ticks.front()) / static_cast<double>(bars);
  std::vector<std::size_t> counts(bars);
  for (const double value : values)
    ++counts[std::min(bars - 1, static_cast<std::size_t>((value - ticks.front()) / width))];
  const double most = static_cast<double>(*std::max_element(counts.begin(), counts.end()));
  const Axes axes(ticks, round_ticks(0, most, 1));
  std::string out = axes.frame(title, "", "cases");
  for (std::size_t bar = 0; bar < bars; ++bar) {
    if (counts[bar] == 0) continue;
    const double from = ticks.front() + static_cast<double>(bar) * width,
                 top = axes.y(static_cast<double>(counts[bar]));
    out +=
        format("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"><title>", axes.x(from) + 0.5, top,
               axes.x(from + width) - axes.x(from) - 1, axes.y(0) - top) +
        format("%zu cases from %s to %s", counts[bar], number(from).c_str(), number(from + width).c_str()) +
        "</title></rect>";
  }
  return out + "</svg>";
}

std::string scatter_svg(const std::string& title, const std::string& x_title, const std::string& y_title,
                        const std::vector<PlotPoint>& points, bool diagonal) {
  const auto [left, right] = std::minmax_element(points.begin(), points.end(),
                                                 [](const auto& a, const auto& b) { return a.x < b.x; });
  const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                               [](const auto& a, const auto& b) { return a.y < b.y; });
  const Axes axes(round_ticks(left->x, right->x), round_ticks(low->y, high->y));
  std::string out = axes.frame(title, x_title, y_title);
  if (diagonal) {
    const double from = std::max(left->x, low->y), to = std::min(right->x, high->y);
    if (to > from)
      out += format("<path class=\"diagonal\" d=\"M%.1f %.1fL%.1f %.1f\"/>", axes.x(from), axes.y(from),
                    axes.x(to), axes.y(to));
  }
  for (const PlotPoint& point : points)
    out += format("<circle%s cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\"><title>",
                  point.marked ? " class=\"marked\"" : "", axes.x(point.x), axes.y(point.y)) +
           xml_escaped(point.title) + "</title></circle>";
  return out + "</svg>";
}

}  // namespace voxtet
