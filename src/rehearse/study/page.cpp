#include "rehearse/study/page.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "rehearse/core/names.hpp"
#include "rehearse/study/summary.hpp"

namespace rehearse::study {
namespace {

constexpr const char* kHead =
    R"(<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>{0}</title><style>
:root{{color-scheme:light dark;--ink:#222;--line:#999;--band:#9cc3e6;--blue:#1f5f99}}
@media(prefers-color-scheme:dark){{:root{{--ink:#ddd;--line:#777;--band:#2c5a85;--blue:#8ec5f5}}}}
body{{font:15px/1.5 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;color:var(--ink)}}
svg{{display:block;margin:.3rem 0 1rem;width:100%;min-width:36rem;max-width:860px}}h2{{font-size:1.15rem;margin-top:2rem}}text{{font-size:12px;fill:var(--ink)}}
.band{{fill:var(--band)}}.predicted{{stroke:var(--blue);fill:none}}.measured{{stroke:var(--ink);fill:none}}.axis{{stroke:var(--line)}}
.wide{{overflow-x:auto}}table{{border-collapse:collapse;font-variant-numeric:tabular-nums}}
th,td{{text-align:left;padding:.15rem 1.2rem .15rem 0;border-bottom:1px solid var(--line);white-space:nowrap}}
</style><h1>{0}</h1>
)";
constexpr double kWidth = 860, kHeight = 150, kLeft = 60, kBottom = 22;

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

/// The first row is the head.
std::string table(const std::vector<std::vector<std::string>>& rows) {
  if (rows.empty()) return "";
  std::string html = "<div class=\"wide\"><table>\n";
  for (std::size_t r = 0; r < rows.size(); ++r) {
    html += "<tr>";
    for (const std::string& cell : rows[r])
      html +=
          r == 0 ? fmt::format("<th scope=\"col\">{}</th>", escaped(cell)) : fmt::format("<td>{}</td>", escaped(cell));
    html += "</tr>\n";
  }
  return html + "</table></div>\n";
}

/// An image of the page's width, with a name for those who do not see it.
std::string drawing(const std::string& name, double height, const std::string& svg) {
  return fmt::format("<div class=\"wide\"><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">{}</svg></div>\n",
                     kWidth, height, escaped(name), svg);
}

/// Numbers to places in a figure.
struct Axes {
  Interval x, y;
  std::string at(double a, double b) const {
    const double px = kLeft + (a - x.low) / std::max(x.high - x.low, 1e-12) * (kWidth - kLeft);
    const double py = (kHeight - kBottom) * (1 - (b - y.low) / std::max(y.high - y.low, 1e-12));
    return fmt::format("{:.1f},{:.1f} ", px, py);
  }
};

struct Curves {
  std::vector<double> t, measured, predicted, low, high;
};

std::string figure(const Curves& c, const std::string& title) {
  if (c.t.empty()) return "";
  const auto [low, high] = std::minmax({*std::ranges::min_element(c.low), *std::ranges::max_element(c.high),
                                        *std::ranges::min_element(c.measured), *std::ranges::max_element(c.measured)});
  const Axes axes{{c.t.front(), c.t.back()}, {low, high}};
  const auto line = [&](const std::vector<double>& y) {
    std::string points;
    for (std::size_t i = 0; i < y.size(); ++i) points += axes.at(c.t[i], y[i]);
    return points;
  };
  std::string band = line(c.high);
  for (std::size_t i = c.t.size(); i-- > 0;) band += axes.at(c.t[i], c.low[i]);
  const std::string svg = fmt::format(
      "<polygon class=\"band\" points=\"{}\"/><polyline class=\"predicted\" "
      "points=\"{}\"/><polyline class=\"measured\" points=\"{}\"/><line class=\"axis\" x1=\"{}\" y1=\"0\" x2=\"{}\" "
      "y2=\"{}\"/><text x=\"0\" y=\"12\">{:.3g}</text><text x=\"0\" y=\"{}\">{:.3g}</text><text x=\"{}\" "
      "y=\"{}\">{:.3g} s</text><text x=\"{}\" y=\"{}\">{:.3g} s</text>",
      band, line(c.predicted), line(c.measured), kLeft, kLeft, kHeight - kBottom, high, kHeight - kBottom, low, kLeft,
      kHeight - 6, c.t.front(), kWidth - 50, kHeight - 6, c.t.back());
  return fmt::format("<div>{}</div>{}", escaped(title), drawing(title, kHeight, svg));
}

Curves curves(const Study& study, const Task& task, const Tested& tested, std::size_t log, std::size_t h, Index s) {
  Curves c;
  const Forecasts& forecasts = tested.model[log];
  const Forecasts::At& at = forecasts.at[h];
  for (Index i = 0; i < at.predicted.rows(); ++i) {
    if (!std::isfinite(at.measured(i, s)) || !std::isfinite(at.predicted(i, s))) continue;
    const double offset = tested.offsets[log](s), mean = at.predicted(i, s) - offset;
    const double half = study.half_band(h, s, at.deviation(i, s));
    c.t.push_back(static_cast<double>(forecasts.starts[static_cast<std::size_t>(i)] + forecasts.horizons[h]) *
                  task.dt_s);
    c.measured.push_back(at.measured(i, s) - offset);
    c.predicted.push_back(mean), c.low.push_back(mean - half), c.high.push_back(mean + half);
  }
  return c;
}

/// A bar between bounds for each continuous parameter: the interval of all logs, and thin ones of those without one.
std::string parameter_bars(const Study& study) {
  const std::vector<Interval> all = intervals_of(study.model);
  if (all.empty()) return "";
  std::vector<std::vector<Interval>> without;
  for (const LogModel& model : study.without) without.push_back(intervals_of(model));
  const identification::PhiPosterior& posterior = *study.model.learned.posterior;
  std::string svg;
  const double row = 42;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Parameter& parameter = posterior.parameters[i];
    const double name = row * static_cast<double>(i) + 14, y = name + 6;
    const auto x = [&](double value) {
      return 100 + 650 * (value - parameter.box.low) / (parameter.box.high - parameter.box.low);
    };
    const auto bar = [&](const Interval& interval, double top, double height) {
      svg += fmt::format("<rect class=\"band\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{}\"/>",
                         x(interval.low), top, std::max(1.0, x(interval.high) - x(interval.low)), height);
    };
    svg += fmt::format(
        "<text x=\"0\" y=\"{}\">{}</text><text x=\"90\" y=\"{}\" text-anchor=\"end\">{:.3g}</text><text x=\"760\" "
        "y=\"{}\">{:.3g}</text><line class=\"axis\" x1=\"100\" x2=\"750\" y1=\"{}\" y2=\"{}\"/>",
        name, escaped(with_unit(parameter.name, parameter.unit)), y + 14, parameter.box.low, y + 14, parameter.box.high,
        y + 18, y + 18);
    bar(all[i], y + 2, 8);
    for (std::size_t m = 0; m < without.size(); ++m)
      if (!without[m].empty()) bar(without[m][i], y + 11 + 3 * static_cast<double>(m), 2);
    const double mean = x(posterior.mean(static_cast<Index>(i)));
    svg +=
        fmt::format("<line class=\"measured\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>", mean, y, y + 12);
  }
  return fmt::format(
      "<h2>Parameters between their bounds</h2><div>Thick: 95 % from all logs; thin: without one of them.</div>{}",
      drawing("Parameters between their bounds", row * static_cast<double>(all.size()), svg));
}

}  // namespace

std::string page(const Study& study, const Problem& problem, const std::string& robot) {
  std::string html = fmt::format(kHead, escaped(robot + ", from logs"));
  for (const Section& section : summary(study, problem)) {
    html += fmt::format("<h2>{}</h2>\n{}", escaped(section.title), table(section.table));
    if (section.notes.empty()) continue;
    html += "<ul>\n";
    for (const std::string& note : section.notes) html += fmt::format("<li>{}</li>\n", escaped(note));
    html += "</ul>\n";
  }
  html += parameter_bars(study);
  const Tested& tested = study.held_out.logs.empty() ? study.left_out_logs : study.held_out;
  for (std::size_t log = 0; log < tested.logs.size(); ++log) {
    html += fmt::format(
        "<h2>Forecasts of {}</h2><div>Blue: predicted from a state so long before, with its 95 % band; the other line: "
        "measured.</div>\n",
        escaped(tested.logs[log]));
    for (std::size_t h = 0; h < study.horizons_s.size(); ++h)
      for (std::size_t s = 0; s < problem.task.states.size(); ++s)
        html += figure(
            curves(study, problem.task, tested, log, h, static_cast<Index>(s)),
            fmt::format("{}, {:.3g} s ahead", with_unit(problem.task.states[s].name, problem.task.states[s].unit),
                        study.horizons_s[h]));
  }
  return html;
}

}  // namespace rehearse::study
