// SPDX-License-Identifier: MIT
#include "output/html.h"

#include "output/deflate.h"
#include "output/html_page.h"

namespace plumb {

HtmlExporter::HtmlExporter(const std::string& path, const RecordingHeader& header)
    : header_(header), file_(path) {
    motions_.bodies.resize(header.bodies.size());
    for (const RecordedDeformable& deformable : header.deformables)
        motions_.deformables.push_back({deformable.count, {}});
}

void HtmlExporter::append(const Frame& frame) {
    expect_bodies_of(header_, frame, file_.path());
    for (std::size_t i = 0; i < motions_.bodies.size(); ++i) {
        const Placement& placement = frame.bodies[i].placement;
        motions_.bodies[i].push_back(
            pose_sample(placement.position - header_.origin, placement.rotation));
    }
    for (std::size_t i = 0, particle = 0; i < header_.deformables.size(); ++i)
        for (std::size_t end = particle + header_.deformables[i].count; particle < end; ++particle)
            motions_.deformables[i].places.push_back(
                (frame.particles[particle] - header_.origin).cast<float>());
    Frame note = frame;
    note.bodies.clear(), note.ids.clear(), note.particles.clear();
    notes_.push_back(std::move(note));
    if (notes_.size() == 1) balls_ = balls_of_interest(header_, frame);
    last_ = frame;
}

void HtmlExporter::finish() {
    const std::vector<Ball> now = balls_of_interest(header_, last_);
    balls_.insert(balls_.end(), now.begin(), now.end());
    const ReplayParts parts = replay_parts(header_, notes_, motions_, balls_);

    file_.append(page_head(header_.name));
    file_.append(data_element("plumb-scene", "application/json", parts.scene));
    file_.append(data_element("plumb-meshes", "text/plain", base64(deflated(parts.meshes))));
    file_.append(data_element("plumb-motion", "text/plain", base64(parts.motion)));
    file_.append(data_element("plumb-particles", "text/plain", base64(parts.particles)));
    file_.append(page_end());
    file_.commit();
}

}  // namespace plumb
