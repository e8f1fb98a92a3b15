// SPDX-License-Identifier: MIT
/// Light, per sample: the sun (one shadow ray into its disc) and one ray into the hemisphere about
/// the normal, which brings the sky's light, or some of the colour of what it meets. That is
/// ambient occlusion with a single bounce.
#include "output/picture.h"

#include "output/palette.h"
#include "output/ray_scene.h"
#include "output/view.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <thread>

namespace plumb {
namespace {

using Vector = Eigen::Vector3f;
using Color = Eigen::Array3f;  // linear light

constexpr float kSunRadius = 0.035f;  // [rad], wider than the true one, for softer shadows
constexpr float kBounce = 0.42f;      // share of a body's colour that it throws onto its neighbours
constexpr float kBandShade =
    0.62f;  // darker band of round bodies, so that their turning can be seen
constexpr float kBandHalfWidth = 0.309f;  // of a sphere's radius
constexpr float kThrough = 0.22f;         // share of the sun's light that passes through cloth
constexpr float kThroughCloth = 0.2f;     // share of the sun's light that cloth lets through
constexpr double kThinnest = 0.75;        // radius of a rope in the middle of the picture [pixels]

float linear(std::uint32_t byte) {
    const float s = static_cast<float>(byte & 0xffu) / 255;
    return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

Color linear_color(std::uint32_t rgb) { return {linear(rgb >> 16), linear(rgb >> 8), linear(rgb)}; }

float smoothstep(float low, float high, float x) {
    const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}

/// Keeps colours up to a brightness and bends what is brighter towards white.
Color tone_mapped(const Color& color) {
    constexpr float kStart = 0.76f, kWhiteness = 0.15f;
    const float peak = color.maxCoeff();
    if (peak < kStart) return color;
    const float room = 1 - kStart;
    const float bent = 1 - room * room / (peak + room - kStart);
    const float keep = 1 / (kWhiteness * (peak - bent) + 1);
    return color * (bent / peak) * keep + bent * (1 - keep);
}

std::uint8_t srgb_byte(float value) {
    const float v = std::clamp(value, 0.0f, 1.0f);
    const float s = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(255 * s));
}

/// Points of the unit square that fill it evenly, with a shift of their own for each pixel and use.
class Sampler {
public:
    Sampler(std::uint32_t pixel, std::uint32_t sample) : pixel_(pixel), sample_(sample) {}

    Eigen::Array2f next() {
        const std::uint32_t shift_x = scattered(pixel_ * 8 + use_);
        const std::uint32_t shift_y = scattered(shift_x + 0x9e3779b9u);
        ++use_;
        // The two steps are 2^32 divided by the plastic number and by its square.
        const std::uint32_t x = shift_x + sample_ * 3242174889u,
                            y = shift_y + sample_ * 2447445414u;
        return {static_cast<float>(x >> 8) * 0x1p-24f, static_cast<float>(y >> 8) * 0x1p-24f};
    }

private:
    std::uint32_t pixel_, sample_, use_ = 0;
};

/// Two unit vectors that stand upright on a unit vector and on each other.
std::array<Vector, 2> tangents(const Vector& normal) {
    const Vector t = normal.unitOrthogonal();
    return {t, normal.cross(t)};
}

Vector cosine_direction(const Vector& normal, const Eigen::Array2f& u) {
    const float angle = 2 * std::numbers::pi_v<float> * u.x(), r = std::sqrt(u.y());
    const auto [s, t] = tangents(normal);
    return (r * std::cos(angle)) * s + (r * std::sin(angle)) * t +
           std::sqrt(std::max(0.0f, 1 - u.y())) * normal;
}

/// What a pixel in the middle of the picture shows [m].
double pixel_size(const View& view, const PictureSettings& settings) {
    const double tangent = std::tan(0.5 * view.field_of_view * std::numbers::pi / 180);
    return 2 * tangent * (view.eye - view.target).norm() / settings.height;
}

/// Everything that stays the same for all pixels of a picture.
class Painter {
public:
    Painter(const RecordingHeader& header, const Frame& frame, const View& view,
            const PictureSettings& settings)
        : settings_(settings),
          up_(up_direction(header).cast<float>()),
          distance_((view.eye - view.target).norm()),
          reach_(14 * distance_),
          scene_(header, frame, view.target, 2 * reach_, kThinnest * pixel_size(view, settings)) {
        place_camera(view);
        place_sun();
        const double wanted = distance_ / 14, power = std::pow(10, std::floor(std::log10(wanted)));
        cell_ = static_cast<float>(power * (wanted < 2 * power ? 1 : wanted < 5 * power ? 2 : 5));
        for (std::size_t i = 0; i < header.bodies.size(); ++i) {
            body_colors_.push_back(linear_color(body_color(header.bodies[i], i)));
        }
        for (std::size_t i = 0; i < header.deformables.size(); ++i) {
            const RecordedDeformable& deformable = header.deformables[i];
            const bool cloth = deformable.kind == DeformableKind::cloth;
            fabrics_.push_back({linear_color(deformable_color(deformable, i)),
                                gloss_of(deformable.kind), cloth ? kThroughCloth : 0});
        }
    }

    void paint_row(Picture& picture, int y) const {
        for (int x = 0; x < settings_.width; ++x) {
            const Color color = pixel(x, y);
            const std::size_t at = 3 * (static_cast<std::size_t>(y) * settings_.width + x);
            for (std::size_t i = 0; i < 3; ++i) {
                picture.rgb[at + i] = srgb_byte(color[static_cast<Eigen::Index>(i)]);
            }
        }
    }

private:
    /// How a deformable looks: its colour, how strongly it shines, of what bodies do, and the share
    /// of light that passes through.
    struct Fabric {
        Color color;
        float gloss, through;
    };

    void place_camera(const View& view) {
        const Eigen::Vector3d back = (view.eye - view.target).normalized();
        Eigen::Vector3d right = up_.cast<double>().cross(back);
        if (right.norm() < 1e-6) right = back.unitOrthogonal();
        right.normalize();
        const double tangent = std::tan(0.5 * view.field_of_view * std::numbers::pi / 180);
        const double aspect = static_cast<double>(settings_.width) / settings_.height;
        eye_ = (view.eye - view.target).cast<float>();
        forward_ = -back.cast<float>();
        right_ = (tangent * aspect * right).cast<float>();
        above_ = (tangent * back.cross(right)).cast<float>();
    }

    void place_sun() {
        const Vector side =
            std::abs(up_.y()) < 0.7f ? Vector(0.55f, -0.35f, 0) : Vector(0.55f, 0, 0.35f);
        sun_ = (up_ + side).normalized();
    }

    Color pixel(int x, int y) const {
        Color sum = Color::Zero();
        const auto number = static_cast<std::uint32_t>(y * settings_.width + x);
        for (int i = 0; i < settings_.samples; ++i) {
            Sampler sampler(number, static_cast<std::uint32_t>(i));
            const Eigen::Array2f in_pixel = sampler.next();
            const float u =
                2 * (static_cast<float>(x) + in_pixel.x()) / static_cast<float>(settings_.width) -
                1;
            const float v = 1 - 2 * (static_cast<float>(y) + in_pixel.y()) /
                                    static_cast<float>(settings_.height);
            sum += tone_mapped(seen((forward_ + u * right_ + v * above_).normalized(), sampler));
        }
        return sum / static_cast<float>(settings_.samples);
    }

    Color sky(const Vector& direction) const {
        const Color horizon = linear_color(0xdde4ea), zenith = linear_color(0x8fa9c1);
        return horizon + (zenith - horizon) * smoothstep(0, 0.75f, direction.dot(up_));
    }

    /// Light that the sky sends down; brighter than it looks, as the sky of a picture is exposed.
    Color sky_light(const Vector& direction) const {
        const float height = direction.dot(up_);
        const Color below(0.50f, 0.48f, 0.46f);
        const Color above = Color(1.02f, 1.08f, 1.16f) * (0.75f + 0.35f * std::max(0.0f, height));
        return below + (above - below) * smoothstep(-0.1f, 0.1f, height);
    }

    Color color_of(const Drawn& drawn) const {
        switch (drawn.kind) {
            case Drawn::Kind::body:
                return body_colors_[drawn.index];
            case Drawn::Kind::deformable:
                return fabrics_[drawn.index].color;
            case Drawn::Kind::link:
                break;
        }
        return linear_color(kLinkColor);
    }

    /// How strongly a kind of deformable shines, of what bodies do.
    static float gloss_of(DeformableKind kind) {
        switch (kind) {
            case DeformableKind::balloon:
                return 1.8f;
            case DeformableKind::solid:
                return 1;
            default:
                return 0.25f;
        }
    }

    Color own_color(const RaySurface& surface) const {
        const Color color = color_of(surface.drawn);
        if (!surface.geometry) return color;
        const Vector& p = surface.point_local;
        switch (surface.geometry->kind) {
            case ShapeKind::plane:
                return ground_color(p);
            case ShapeKind::sphere: {
                const auto radius = static_cast<float>(surface.geometry->radius);
                return std::abs(p.y()) < kBandHalfWidth * radius ? Color(color * kBandShade)
                                                                 : color;
            }
            case ShapeKind::capsule: {
                const auto half = static_cast<float>(surface.geometry->half_height);
                return std::abs(p.y()) > half ? Color(color * kBandShade) : color;
            }
            default:
                return color;
        }
    }

    Color ground_color(const Vector& p) const {
        const auto near_line = [&p](float cell, float width) {
            const auto off = [cell](float x) { return std::abs(x - cell * std::round(x / cell)); };
            return std::min(off(p.x()), off(p.z())) < width;
        };
        const bool thick = near_line(5 * cell_, 0.016f * cell_),
                   thin = near_line(cell_, 0.009f * cell_);
        return linear_color(0xb4bac0) * (thick ? 0.74f : thin ? 0.87f : 1.0f);
    }

    static bool is_plane(const RaySurface& surface) {
        return surface.geometry && surface.geometry->kind == ShapeKind::plane;
    }

    static bool is_deformable(const RaySurface& surface) {
        return surface.drawn.kind == Drawn::Kind::deformable;
    }

    /// Share of the light on its other side that a surface lets through.
    float through(const RaySurface& surface) const {
        return is_deformable(surface) ? fabrics_[surface.drawn.index].through : 0;
    }

    Color seen(const Vector& direction, Sampler& sampler) const {
        const std::optional<RaySurface> surface = scene_.nearest(eye_, direction);
        if (!surface) return sky(direction);
        const Color color =
            own_color(*surface) * light(*surface, sampler) + gleam(*surface, direction);
        if (!is_plane(*surface)) return color;
        const auto reach = static_cast<float>(reach_);
        const float far = smoothstep(0.25f * reach, reach, surface->point.norm());
        return color + (sky(Vector::Zero()) - color) * far;
    }

    /// Light that falls onto a surface, the sun's and the sky's.
    Color light(const RaySurface& surface, Sampler& sampler) const {
        const Vector& from = surface.start;
        Color sum = Color::Zero();
        const Eigen::Array2f in_disc = sampler.next();
        const float slope = surface.normal.dot(sun_);
        const float share = slope > 0 ? 1 : through(surface);
        const Vector lit_from = slope > 0 ? from : Vector(2 * surface.point - from);
        if (share > 0 && !scene_.blocked(lit_from, sun_direction(in_disc))) {
            sum += Color(1.10f, 1.02f, 0.90f) * std::abs(slope) * share;
        }
        const Vector direction = cosine_direction(surface.normal, sampler.next());
        const std::optional<RaySurface> other = scene_.nearest(from, direction);
        sum += 0.52f * (other ? Color(kBounce * color_of(other->drawn)) : sky_light(direction));
        return sum;
    }

    Vector sun_direction(const Eigen::Array2f& u) const {
        const float angle = 2 * std::numbers::pi_v<float> * u.x(),
                    r = kSunRadius * std::sqrt(u.y());
        const auto [s, t] = tangents(sun_);
        return (sun_ + (r * std::cos(angle)) * s + (r * std::sin(angle)) * t).normalized();
    }

    /// What a smooth coat mirrors of the sky (Schlick) and of the sun.
    Color gleam(const RaySurface& surface, const Vector& direction) const {
        if (is_plane(surface)) return Color::Zero();
        const float gloss = is_deformable(surface) ? fabrics_[surface.drawn.index].gloss : 1;
        const float facing = std::max(0.0f, -direction.dot(surface.normal));
        const float fresnel = 0.03f + 0.25f * std::pow(1 - facing, 5.0f);
        const Vector mirrored = direction + 2 * facing * surface.normal;
        const float highlight = std::pow(std::max(0.0f, mirrored.dot(sun_)), 40.0f);
        const bool lit = highlight > 1e-3f && surface.normal.dot(sun_) > 0;
        return gloss * (fresnel * sky_light(mirrored) * 0.6f + (lit ? 0.22f * highlight : 0.0f));
    }

    PictureSettings settings_;
    Vector up_;
    double distance_, reach_;  // [m]
    RayScene scene_;
    Vector eye_, forward_, right_,
        above_;  // relative to the target; right and above reach to the picture's rim
    Vector sun_;
    float cell_ = 1;  // of the ground's grid [m]
    std::vector<Color> body_colors_;
    std::vector<Fabric> fabrics_;  // [deformable]
};

}  // namespace

Picture draw_picture(const RecordingHeader& header, const Frame& frame,
                     const PictureSettings& settings) {
    const double aspect = static_cast<double>(settings.width) / settings.height;
    const View view = chosen_view(header, balls_of_interest(header, frame), aspect);
    const Painter painter(header, frame, view, settings);

    Picture picture{settings.width, settings.height, {}};
    picture.rgb.resize(3 * static_cast<std::size_t>(settings.width) * settings.height);
    std::atomic<int> next_row = 0;
    const auto work = [&] {
        for (int y = next_row++; y < settings.height; y = next_row++) painter.paint_row(picture, y);
    };
    const unsigned wanted =
        settings.threads ? settings.threads : std::thread::hardware_concurrency();
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < wanted; ++i) helpers.emplace_back(work);
    work();
    helpers.clear();
    return picture;
}

}  // namespace plumb
