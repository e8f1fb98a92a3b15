// SPDX-License-Identifier: MIT
#include "study/journal.h"

#include "output/error.h"
#include "study/findings.h"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <set>
#include <sstream>

namespace plumb::study {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

constexpr const char* kPlanFile = "study.json";
constexpr const char* kRunsFile = "runs.csv";
constexpr const char* kRunsHead = "row,judged,status,us_per_s,us_per_s_solver,errors,note\n";

/// A line of CSV: fields are quoted where need be, and no field holds an end of line.
std::string csv_line(const std::vector<std::string>& fields) {
    std::string line;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        if (i > 0) line.push_back(',');
        const bool quoted = fields[i].find_first_of(",\"") != std::string::npos;
        if (quoted) line.push_back('"');
        for (const char c : fields[i]) {
            if (c == '"') line.push_back('"');
            line.push_back(c == '\n' || c == '\r' ? ' ' : c);
        }
        if (quoted) line.push_back('"');
    }
    line.push_back('\n');
    return line;
}

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += c, ++i;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    return fields;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

Json point_json(const Point& p) {
    return {{"subject", p.subject},        {"curve", p.curve},      {"precision", p.precision},
            {"ladder", name_of(p.ladder)}, {"value", p.value},      {"collider", p.collider},
            {"contacts", p.contacts},      {"settings", p.settings}};
}

Ladder ladder_of(const std::string& name) {
    for (const Ladder l : {Ladder::substeps, Ladder::iterations, Ladder::step, Ladder::accuracy})
        if (name == name_of(l)) return l;
    throw std::runtime_error("there is no ladder \"" + name + "\"");
}

Point point_of(const Json& j) {
    return {j.at("subject"),   j.at("curve"),
            j.at("precision"), ladder_of(j.at("ladder")),
            j.at("value"),     j.at("collider"),
            j.at("contacts"),  j.at("settings").get<std::vector<std::string>>()};
}

Json subject_json(const SubjectSummary& s) {
    Json metrics = Json::array();
    for (const auto& m : s.metrics)
        metrics.push_back({{"name", m.name}, {"unit", m.unit}, {"what", m.what}});
    return {{"name", s.name},
            {"title", s.title},
            {"reference", s.reference},
            {"metrics", metrics},
            {"tolerance", s.tolerance},
            {"orders",
             {{"substeps", s.orders.substeps},
              {"iterations", s.orders.iterations},
              {"step", s.orders.step}}},
            {"horizon", s.horizon},
            {"reference_error", s.reference_error},
            {"reference_substeps", s.reference_substeps},
            {"fingerprint", s.fingerprint}};
}

SubjectSummary subject_of(const Json& j) {
    SubjectSummary s{.name = j.at("name"),
                     .title = j.at("title"),
                     .reference = j.at("reference"),
                     .metrics = {},
                     .tolerance = j.at("tolerance"),
                     .orders = {j.at("orders").at("substeps"), j.at("orders").at("iterations"),
                                j.at("orders").at("step")},
                     .horizon = j.at("horizon"),
                     .reference_error = j.at("reference_error"),
                     .reference_substeps = j.at("reference_substeps"),
                     .fingerprint = j.at("fingerprint")};
    for (const Json& m : j.at("metrics"))
        s.metrics.push_back({m.at("name"), m.at("unit"), m.at("what")});
    return s;
}

Status status_of(const std::string& name) {
    for (const Status s : {Status::done, Status::diverged, Status::refused})
        if (name == name_of(s)) return s;
    return Status::not_run;
}

std::vector<double> numbers_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<double> numbers;
    for (double x; in >> x;) numbers.push_back(x);
    return numbers;
}

std::string line_of(std::size_t row, bool judged, const Outcome& o) {
    std::string errors;
    for (const double e : o.errors) errors.append(errors.empty() ? "" : " ").append(number(e));
    return csv_line({std::to_string(row), std::to_string(int(judged)),
                     std::string(name_of(o.status)), number(o.cost.total), number(o.cost.solver),
                     errors, o.note});
}

/// Enters the lines of a journal. What follows the last end of a line was cut off while it was
/// written, and is left out.
void read_runs(const std::string& text, StudyTable& table, const std::string& path) {
    std::size_t begin = 0, line_number = 0;
    for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
        if (++line_number == 1) continue;
        const std::vector<std::string> f = fields_of(text.substr(begin, end - begin));
        const std::size_t row = f.size() == 7 ? std::strtoull(f[0].c_str(), nullptr, 10) : ~0ull;
        if (row >= table.rows.size())
            throw UnreadableFile(
                path, "line " + std::to_string(line_number) + " is none of a sweep's journal");
        const bool judged = f[1] == "1";
        const std::size_t wanted = table.find(table.rows[row].point.subject)->metrics.size();
        if (judged && f[2] == name_of(Status::done) && numbers_of(f[5]).size() != wanted)
            throw UnreadableFile(path, "line " + std::to_string(line_number) +
                                           " has not as many errors as its subject has metrics");
        enter(table.rows[row], judged,
              {status_of(f[2]),
               f[6],
               numbers_of(f[5]),
               {std::strtod(f[3].c_str(), nullptr), std::strtod(f[4].c_str(), nullptr)}});
    }
}

bool same_plan(const StudyTable& a, const StudyTable& b) {
    StudyTable x = a, y = b;
    for (StudyTable* t : {&x, &y}) {
        t->machine = {};
        for (SubjectSummary& s : t->subjects) s.reference_error = s.horizon = 0;  // measured
    }
    return plan_json(x) == plan_json(y);
}

std::string in_folder(const std::string& folder, const char* file) {
    return (fs::path(folder) / file).string();
}

StudyTable read_plan(const std::string& folder) {
    const std::string path = in_folder(folder, kPlanFile);
    try {
        return plan_from_json(read_file(path));
    } catch (const UnreadableFile&) {
        throw UnreadableFile(folder, std::string("holds no sweep (there is no ") + kPlanFile + ")");
    } catch (const std::exception& e) {
        throw UnreadableFile(path, std::string("is not the plan of a sweep: ") + e.what());
    }
}

}  // namespace

std::string plan_json(const StudyTable& table) {
    Json subjects = Json::array(), points = Json::array();
    for (const SubjectSummary& s : table.subjects) subjects.push_back(subject_json(s));
    for (const Row& r : table.rows) points.push_back(point_json(r.point));
    const Json j = {{"machine",
                     {{"cpu", table.machine.cpu},
                      {"flags", table.machine.flags},
                      {"version", table.machine.version}}},
                    {"subjects", subjects},
                    {"points", points}};
    return j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

StudyTable plan_from_json(std::string_view text) {
    const Json j = Json::parse(text);
    StudyTable table;
    const Json& m = j.at("machine");
    table.machine = {m.at("cpu"), m.at("flags"), m.at("version")};
    for (const Json& s : j.at("subjects")) table.subjects.push_back(subject_of(s));
    for (const Json& p : j.at("points")) {
        Row row;
        row.point = point_of(p);
        table.rows.push_back(row);
    }
    return table;
}

void enter(Row& row, bool judged, const Outcome& o) {
    if (judged) {
        row.status = o.status;
        row.note = o.note;
        row.errors = o.errors;
    }
    if (o.status == Status::done || o.status == Status::diverged) row.costs.push_back(o.cost);
}

Journal::Journal(const std::string& folder, StudyTable& table)
    : path_(in_folder(folder, kRunsFile)) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (failed) throw OutputError(folder, "cannot be made: " + failed.message());
    const bool goes_on = fs::exists(in_folder(folder, kPlanFile)) && fs::exists(path_);
    std::string text;
    if (goes_on) {
        const StudyTable before = read_plan(folder);
        if (before.machine.version != table.machine.version ||
            before.machine.flags != table.machine.flags || before.machine.cpu != table.machine.cpu)
            throw OutputError(folder,
                              "holds a sweep of another machine or build; name another "
                              "folder");
        if (!same_plan(before, table))
            throw OutputError(folder,
                              "holds another sweep; name another folder, or remove this one");
        text = read_file(path_);
        read_runs(text, table, path_);
        text.erase(text.rfind('\n') + 1);
    } else {
        WholeFile plan(in_folder(folder, kPlanFile));
        plan.append(plan_json(table));
        plan.commit();
        text = kRunsHead;
    }
    WholeFile runs(path_);
    runs.append(text);
    runs.commit();
    file_.open(path_, std::ios::app | std::ios::binary);
    if (!file_) throw OutputError(path_, "cannot be written");
}

void Journal::add(std::size_t row, bool judged, const Outcome& outcome) {
    file_ << line_of(row, judged, outcome) << std::flush;
    if (!file_) throw OutputError(path_, "cannot be written: the disk may be full");
}

std::optional<StudyTable> plan_in(const std::string& folder) {
    if (!fs::exists(in_folder(folder, kPlanFile))) return std::nullopt;
    return read_plan(folder);
}

StudyTable merged(const std::vector<std::string>& folders) {
    std::optional<StudyTable> all;
    std::set<fs::path> seen;
    for (const std::string& folder : folders) {
        std::error_code failed;
        if (!seen.insert(fs::weakly_canonical(folder, failed)).second)
            throw OutputError(folder, "is named twice");
        const StudyTable plan = read_plan(folder);
        if (!all) all = plan;
        if (!same_plan(*all, plan))
            throw OutputError(folder, "is of another sweep than " + folders.front());
        if (all->machine.version != plan.machine.version ||
            all->machine.flags != plan.machine.flags)
            throw OutputError(folder, "was run by another build than " + folders.front());
        if (all->machine.cpu != plan.machine.cpu) all->machine.cpu = "several processors";
        const std::string path = in_folder(folder, kRunsFile);
        read_runs(read_file(path), *all, path);
    }
    return *all;
}

std::string table_csv(const StudyTable& table) {
    std::string text =
        "subject,curve,precision,ladder,value,collider,contacts,settings,status,metric,error,unit,"
        "others,us_per_s,us_per_s_solver,runs,front,note,version,flags,cpu\n";
    const std::vector<bool> front = front_of(table);
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const Row& r = table.rows[i];
        const Point& p = r.point;
        const SubjectSummary& s = *table.find(p.subject);
        const bool done = r.status == Status::done && !r.errors.empty();
        std::string others;
        for (std::size_t m = 1; done && m < r.errors.size(); ++m)
            others.append(others.empty() ? "" : " ")
                .append(s.metrics[m].name + "=" + number(r.errors[m]));
        const Cost cost = r.median_cost();
        text += csv_line({p.subject,
                          p.curve,
                          p.precision,
                          std::string(name_of(p.ladder)),
                          number(p.value),
                          p.collider,
                          p.contacts,
                          p.settings_text(),
                          std::string(name_of(r.status)),
                          s.metrics.front().name,
                          done ? number(r.error()) : std::string(),
                          s.metrics.front().unit,
                          others,
                          done ? number(cost.total) : std::string(),
                          done ? number(cost.solver) : std::string(),
                          std::to_string(r.costs.size()),
                          std::to_string(int(front[i])),
                          r.note,
                          table.machine.version,
                          table.machine.flags,
                          table.machine.cpu});
    }
    return text;
}

}  // namespace plumb::study
