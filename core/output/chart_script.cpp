// SPDX-License-Identifier: MIT
#include "output/chart_script.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace plumb {
namespace {

constexpr std::array<const char*, 9> kColors{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b8860b",
                                             "#56b4e9", "#8c564b", "#7b5ea7", "#6b7780"};
constexpr std::array<int, 5> kMarks{7, 5, 9, 13, 11};
constexpr std::array<const char*, 4> kDashes{"1", "(12,7)", "(3,5)", "(14,5,3,5)"};

constexpr int kLeft = 104, kRight = 24, kAxis = 84, kLine = 26;  ///< [pixels]
constexpr int kWidth = kLeft + kPlotWidth + kRight;
/// 15 pixels of SVG. A PNG of twice the size counts in points, of which 15 are 20 pixels, hence its
/// scale of 1.5.
constexpr const char* kFont = "font 'DejaVu Sans,15'";
constexpr int kTitleHeight = 19;                    ///< [pixels]
constexpr double kLetter = 8.7, kTitleLetter = 11;  ///< mean widths [pixels]

std::string text_of(double value) {
    std::array<char, 32> buffer{};
    const std::to_chars_result end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), end.ptr};
}

/// Characters of a text in UTF-8.
std::size_t letters(std::string_view text) {
    return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xc0) != 0x80;
    }));
}

/// Words of a text in lines of at most `most` letters.
std::vector<std::string> wrapped(const std::string& text, std::size_t most) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        if (!line.empty() && letters(line) + 1 + letters(word) > most) {
            lines.push_back(line);
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
        at = end + 1;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
}

/// Where everything stands outside the frame [pixels], from the top.
struct Sheet {
    std::vector<std::string> titles, captions;
    std::size_t columns = 1;  ///< of the legend
    int frame = 0, legend = 0, caption = 0, height = 0;

    std::string down(double pixels) const { return text_of(1 - pixels / height); }
};

bool has_failures(const ChartStage& stage) { return stage.top > stage.y.high; }

Sheet sheet_of(const Chart& chart, const ChartStage& stage) {
    Sheet sheet;
    sheet.titles = wrapped(chart.title, static_cast<std::size_t>((kWidth - 40) / kTitleLetter));
    sheet.captions = wrapped(chart.caption, static_cast<std::size_t>((kWidth - 40) / kLetter));
    std::size_t longest = 10, entries = has_failures(stage) + !chart.front.empty();
    for (const ChartSeries& series : chart.series)
        longest = std::max(longest, letters(series.name));
    entries += chart.series.size();
    // gnuplot takes letters in a legend to be wider than they are
    const double column = 90 + 1.1 * kLetter * static_cast<double>(longest);
    sheet.columns = std::clamp<std::size_t>(static_cast<std::size_t>((kWidth - 40) / column), 1,
                                            std::max<std::size_t>(entries, 1));
    const int rows = static_cast<int>((entries + sheet.columns - 1) / sheet.columns);
    sheet.frame = 22 + kLine * static_cast<int>(sheet.titles.size());
    sheet.legend = sheet.frame + kPlotHeight + kAxis;
    sheet.caption = sheet.legend + kLine * rows + 20;
    sheet.height = sheet.caption + kLine * static_cast<int>(sheet.captions.size()) + 4;
    return sheet;
}

/// Chooses `own` where there is a choice, and else what its place gives.
template <class List>
auto chosen(const List& list, int own, std::size_t place) {
    return list[(own >= 0 ? static_cast<std::size_t>(own) : place) % list.size()];
}

std::string block(const std::string& name, const std::vector<ChartPoint>& points,
                  const Chart& chart) {
    std::string text = "# ";
    for (const char c : name) text += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    text += '\n';
    bool any = false;
    for (const ChartPoint& point : points) {
        const bool drawn = is_drawable(point, chart);
        text += drawn ? text_of(point.x) + ' ' + text_of(point.y) + '\n' : any ? "\n" : "";
        any = drawn;
    }
    if (text.ends_with("\n\n")) text.pop_back();
    // gnuplot counts no block that has no line at all.
    if (std::none_of(points.begin(), points.end(),
                     [&](const ChartPoint& p) { return is_drawable(p, chart); }))
        text += "NaN NaN\n";
    return text + "\n\n";
}

/// Ticks of a logarithmic axis: powers of ten by name, and what stands between them without; none
/// where gnuplot's own choice is better.
std::vector<std::string> log_ticks(const ChartAxis& axis) {
    const int low = static_cast<int>(std::floor(std::log10(axis.low)));
    const int high = static_cast<int>(std::floor(std::log10(axis.high) + 1e-9));
    const int each = std::max(1, (high - low + 8) / 9);
    const bool plain = axis.low > 0.9e-3 && axis.high < 1e6;
    std::vector<std::string> ticks;
    for (int k = low; k <= high; ++k) {
        const std::string power = "1e" + std::to_string(k);
        const std::string words =
            plain ? "sprintf('%.7g', " + power + ")" : "'10^{" + std::to_string(k) + "}'";
        if (std::pow(10, k) >= axis.low * (1 - 1e-9))
            ticks.push_back((k % each == 0 ? words : "''") + " " + power);
        for (int i = 2; each == 1 && i < 10; ++i) {
            const double value = i * std::pow(10, k);
            if (value > axis.low && value < axis.high)
                ticks.push_back("'' " + std::to_string(i) + "e" + std::to_string(k) + " 1");
        }
    }
    return high > low ? ticks : std::vector<std::string>{};
}

/// A label in as many lines as a side of so many pixels calls for.
std::string wrapped_label(const std::string& label, int side) {
    std::string text;
    for (const std::string& line : wrapped(label, static_cast<std::size_t>(side / kLetter)))
        text += (text.empty() ? "" : ".\"\\n\".") + gnuplot_string(line);
    return text.empty() ? gnuplot_string("") : text;
}

std::string axis_lines(const char* name, const ChartAxis& axis, double top,
                       const std::string& label, int side) {
    const std::string n = name;
    std::string text = "set " + n + "label " + wrapped_label(label, side) + " noenhanced\n";
    text += "set " + n + "range [" + text_of(axis.low) + ":" + text_of(top) + "]\n";
    if (!axis.log) return text;
    text += "set logscale " + n + "\n";
    const std::vector<std::string> ticks = log_ticks(axis);
    if (ticks.empty()) return text;
    text += "set " + n + "tics (";
    for (const std::string& tick : ticks) text += (&tick == ticks.data() ? "" : ", ") + tick;
    return text + ")\n";
}

std::string label_line(const std::string& text, const std::string& place,
                       const std::string& looks) {
    return "set label " + gnuplot_string(text) + " at " + place + " noenhanced " + looks + "\n";
}

/// Title, caption, rules and the band of failures.
std::string label_lines(const Chart& chart, const ChartStage& stage, const Sheet& sheet) {
    std::string text;
    const auto down = [&](double pixels) { return "screen " + sheet.down(pixels); };
    const std::string left = "screen " + text_of(20.0 / kWidth) + ", ";
    double at = 24;
    for (const std::string& line : sheet.titles) {
        text +=
            label_line(line, left + down(at), "left font '," + std::to_string(kTitleHeight) + "'");
        at += kLine;
    }
    at = sheet.caption;
    for (const std::string& line : sheet.captions) {
        text += label_line(line, left + down(at), "left textcolor rgb '#4a5763'");
        at += kLine;
    }
    for (const ChartRule& rule : chart.rules) {
        if (!stage.y.takes(rule.y)) continue;
        text += label_line(rule.name, "graph 0.992, first " + text_of(rule.y),
                           "right offset 0, 0.6 front");
    }
    if (!has_failures(stage)) return text;
    const std::string high = text_of(stage.y.high);
    return text + "set object rectangle from graph 0, first " + high +
           " to graph 1, graph 1 fillcolor rgb '#f0f2f4' fillstyle solid noborder behind\n" +
           label_line("failed", "graph -0.008, graph " + text_of(1 - 10.0 / kPlotHeight), "right");
}

/// The plot command: front and rules beneath, then lines, then failures.
std::string plot_lines(const std::string& name, const Chart& chart, const ChartStage& stage) {
    const std::string file = gnuplot_string(name + ".dat");
    std::vector<std::string> parts;
    const auto of = [&](std::size_t index) {
        return file + " index " + std::to_string(index) + " using 1:2 ";
    };
    if (!chart.front.empty())
        parts.push_back(of(0) + "with steps lw 6 lc rgb '#b9bfc6' title 'Pareto front' noenhanced");
    for (const ChartRule& rule : chart.rules) {
        if (stage.y.takes(rule.y))
            parts.push_back(text_of(rule.y) +
                            " with lines dt (10,6) lw 1.4 lc rgb '#3a444e' notitle");
    }
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const ChartSeries& s = chart.series[i];
        const int mark = chosen(kMarks, s.mark, i);
        std::string part = of(1 + 2 * i);
        part += s.stairs ? "with steps" : "with linespoints ps 0.95 pt " + std::to_string(mark);
        part += std::string(" dt ") + chosen(kDashes, s.dash, i / kColors.size());
        part += std::string(" lw 2 lc rgb '") + chosen(kColors, s.color, i);
        parts.push_back(part + "' title " + gnuplot_string(s.name) + " noenhanced");
    }
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        if (stage.failures[i].empty()) continue;
        parts.push_back(of(2 + 2 * i) + "with points pt 2 ps 1.25 lw 2.4 lc rgb '" +
                        chosen(kColors, chart.series[i].color, i) + "' notitle");
    }
    if (has_failures(stage))
        parts.emplace_back(
            "NaN with points pt 2 ps 1.25 lw 2.4 lc rgb '#1d2731' title 'failed, at the cost it "
            "had'");
    if (parts.empty()) parts.emplace_back("NaN notitle");
    std::string text = "plot ";
    for (const std::string& part : parts)
        text += (&part == parts.data() ? "" : ", \\\n     ") + part;
    return text + "\n";
}

}  // namespace

std::string gnuplot_string(const std::string& text) {
    // gnuplot doubles a quote within quotes, but reads more than two in a row wrongly, and looks
    // for commands between grave accents in some places: both become characters that only look
    // alike.
    std::string result = "'";
    for (const char c : text) {
        if (c == '\'')
            result += "\u2019";
        else if (c == '`')
            result += "\u02cb";
        else
            result += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? ' ' : c;
    }
    return result + "'";
}

std::string chart_data(const Chart& chart, const ChartStage& stage) {
    // The last stair reaches as far as the chart.
    const auto stairs = [&](std::vector<ChartPoint> points) {
        if (!points.empty()) points.push_back({stage.x.high, points.back().y});
        return points;
    };
    std::string text = block("Pareto front", stairs(chart.front), chart);
    for (std::size_t i = 0; i < chart.series.size(); ++i) {
        const ChartSeries& series = chart.series[i];
        text += block(series.name, series.stairs ? stairs(series.points) : series.points, chart);
        text += block("failures of " + series.name, stage.failures[i], chart);
    }
    return text;
}

std::string chart_script(const std::string& name, const Chart& chart, const ChartStage& stage) {
    const Sheet sheet = sheet_of(chart, stage);
    const auto across = [](int pixels) { return "at screen " + text_of(double(pixels) / kWidth); };
    std::string text = "# Run in this folder: gnuplot " + name + ".gp\nset encoding utf8\n";
    text += "set terminal svg size " + std::to_string(kWidth) + "," + std::to_string(sheet.height) +
            " dynamic " + kFont + " background '#ffffff'\n";
    text += "set output " + gnuplot_string(name + ".svg") + "\n";
    text += "set lmargin " + across(kLeft) + "\nset rmargin " + across(kLeft + kPlotWidth) + "\n";
    text += "set tmargin at screen " + sheet.down(sheet.frame) + "\n";
    text += "set bmargin at screen " + sheet.down(sheet.frame + kPlotHeight) + "\n";
    text += axis_lines("x", stage.x, stage.x.high, chart.x_label, kPlotWidth);
    text += axis_lines("y", stage.y, stage.top, chart.y_label, kPlotHeight);
    text +=
        "set tics out nomirror\nset border 3 lw 1.2 lc rgb '#4a5763'\n"
        "set grid xtics ytics mxtics mytics lt 1 lw 1 lc rgb '#d3d9de', lt 1 lw 0.6 lc rgb "
        "'#eaedf0'\n";
    text += "set key at screen " + text_of(16.0 / kWidth) + ", screen " + sheet.down(sheet.legend) +
            " left top horizontal Left reverse samplen 3 spacing 1.15 maxcols " +
            std::to_string(sheet.columns) + "\n";
    text += label_lines(chart, stage, sheet) + plot_lines(name, chart, stage);
    text += "set terminal pngcairo size " + std::to_string(2 * kWidth) + "," +
            std::to_string(2 * sheet.height) + " " + kFont +
            " fontscale 1.5 linewidth 2 pointscale 2 background '#ffffff'\n";
    return text + "set output " + gnuplot_string(name + ".png") + "\nreplot\nunset output\n";
}

}  // namespace plumb
