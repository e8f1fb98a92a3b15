// SPDX-License-Identifier: MIT
#include "output/csv.h"

#include "falling.h"
#include "soft.h"
#include "temporary_folder.h"

namespace plumb::test {
namespace {

using Row = std::vector<std::string>;

/// Reads fields as RFC 4180 has them; line breaks may stand within quotes.
std::vector<Row> parsed(const std::string& text) {
    std::vector<Row> rows;
    Row row;
    std::string field;
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
            field += text[++i];
        } else if (c == '"') {
            quoted = !quoted;
        } else if (!quoted && (c == ',' || c == '\n')) {
            row.push_back(std::exchange(field, {}));
            if (c == '\n') rows.push_back(std::exchange(row, {}));
        } else {
            field += c;
        }
    }
    return rows;
}

class CsvTest : public TemporaryFolder {};

TEST_F(CsvTest, EveryBitComesBack) {
    Scene scene = falling_scene(6);
    scene.bodies[3].name = "a, \"quoted\"\nname";
    const RecordingHeader header = recording_header(scene, {});
    CsvExporter exporter(path("run.csv"), header);
    std::vector<Frame> frames;
    for (std::uint64_t i = 0; i < 3; ++i) {
        frames.push_back(falling_frame(scene, i, static_cast<double>(i) / 7));
        exporter.append(frames.back());
    }
    exporter.finish();

    const std::vector<Row> rows = parsed(read_file(path("run.csv")));
    ASSERT_EQ(rows.size(), 1 + 3 * scene.bodies.size());
    EXPECT_EQ(rows[0], (Row{"step", "time", "body", "name", "x", "y", "z", "qx", "qy", "qz", "qw",
                            "vx", "vy", "vz", "wx", "wy", "wz"}));
    for (std::size_t r = 1; r < rows.size(); ++r) {
        const std::size_t f = (r - 1) / scene.bodies.size(), i = (r - 1) % scene.bodies.size();
        const Row& row = rows[r];
        ASSERT_EQ(row.size(), 17u);
        EXPECT_EQ(std::stoull(row[0]), frames[f].step);
        EXPECT_EQ(std::stod(row[1]), frames[f].time);
        EXPECT_EQ(std::stoull(row[2]), i);
        EXPECT_EQ(row[3], scene.bodies[i].name);
        const BodyState& body = frames[f].bodies[i];
        for (Eigen::Index k = 0; k < 3; ++k) {
            const auto at = [&](Eigen::Index column) {
                return std::stod(row[static_cast<std::size_t>(column + k)]);
            };
            EXPECT_EQ(at(4), body.placement.position[k]);
            EXPECT_EQ(at(7), body.placement.rotation.coeffs()[k]);
            EXPECT_EQ(at(11), body.velocity[k]);
            EXPECT_EQ(at(14), body.angular_velocity[k]);
        }
        EXPECT_EQ(std::stod(row[10]), body.placement.rotation.w());
    }
}

TEST_F(CsvTest, PointsOfDeformablesFollowTheBodies) {
    const Scene scene = soft_scene(1);
    CsvExporter exporter(path("run.csv"), recording_header(scene, {}));
    std::vector<Frame> frames{soft_frame(scene, 0, 0), soft_frame(scene, 4, 1.0 / 7)};
    for (const Frame& frame : frames) exporter.append(frame);
    exporter.finish();

    const std::vector<Row> rows = parsed(read_file(path("run.csv")));
    const std::size_t a_frame = scene.bodies.size() + frames[0].particles.size();
    ASSERT_EQ(rows.size(), 1 + 2 * a_frame);
    EXPECT_EQ(rows[0][4], "x");
    EXPECT_EQ(rows[0][17], "deformable");
    EXPECT_EQ(rows[0][18], "point");
    for (const Row& row : rows) ASSERT_EQ(row.size(), 19u);
    for (std::size_t f = 0; f < 2; ++f) {
        std::size_t r = 1 + f * a_frame, particle = 0;
        EXPECT_EQ(rows[r][2], "0");
        EXPECT_EQ(rows[r][17] + rows[r][18], "");
        for (std::size_t i = 0; i < scene.deformables.size(); ++i) {
            for (std::size_t point = 0; point < scene.deformables[i].points.size(); ++point) {
                const Row& row = rows[++r];
                EXPECT_EQ(std::stoull(row[0]), frames[f].step);
                EXPECT_EQ(std::stod(row[1]), frames[f].time);
                EXPECT_EQ(row[3], scene.deformables[i].name);
                EXPECT_EQ(row[17], std::to_string(i));
                EXPECT_EQ(row[18], std::to_string(point));
                for (std::size_t k = 0; k < 3; ++k)
                    EXPECT_EQ(std::stod(row[4 + k]),
                              frames[f].particles[particle][static_cast<Eigen::Index>(k)]);
                for (std::size_t k = 7; k < 17; ++k) EXPECT_EQ(row[k] + row[2], "");
                ++particle;
            }
        }
    }
}

TEST_F(CsvTest, RowsAreInTheFileBeforeItIsFinished) {
    const Scene scene = falling_scene(1);
    CsvExporter exporter(path("run.csv"), recording_header(scene, {}));
    exporter.append(falling_frame(scene, 0, 0));
    EXPECT_EQ(parsed(read_file(path("run.csv"))).size(), 1 + scene.bodies.size());
}

}  // namespace
}  // namespace plumb::test
