// SPDX-License-Identifier: MIT
/// The state between two steps as bytes:
///
///     "plumb state\n", version u32, foundation u64, length u64 and hash u64 of what follows:
///     World::excluded, Parts::broken, what outlives a step (host/world_state.h), pairs that touch
///
/// Lists begin with their length as u64; numbers are little-endian.
#include "host/simulation_parts.h"
#include "host/world_state.h"
#include "math/fnv1a.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

namespace plumb {
namespace {

constexpr std::string_view kMagic = "plumb state\n";
constexpr std::size_t kHeader = kMagic.size() + 4 + 3 * 8;

using Keys = std::vector<std::uint64_t>;

std::uint64_t hash_of(std::string_view bytes) {
    Fnv1a hash;
    hash.add(bytes.data(), bytes.size());
    return hash.value();
}

/// What stands behind the header. Throws std::invalid_argument where the bytes are not a state of
/// this foundation.
std::string_view state_in(std::string_view bytes, std::uint64_t wanted) {
    if (bytes.substr(0, kMagic.size()) != kMagic)
        throw std::invalid_argument("the bytes are no state of a simulation");
    if (bytes.size() < kHeader) throw std::invalid_argument("the state is cut short");
    ByteReader header(bytes.substr(kMagic.size()));
    const auto version = header.take<std::uint32_t>();
    if (version != kStateVersion)
        throw std::invalid_argument("the state is of version " + std::to_string(version) +
                                    ", and this library reads version " +
                                    std::to_string(kStateVersion));
    const auto foundation = header.take<std::uint64_t>(), length = header.take<std::uint64_t>(),
               hash = header.take<std::uint64_t>();
    const std::string_view state = bytes.substr(kHeader);
    if (state.size() < length) throw std::invalid_argument("the state is cut short");
    if (state.size() > length) throw std::invalid_argument("bytes follow behind the state");
    if (hash_of(state) != hash) throw std::invalid_argument("the state is damaged");
    if (foundation != wanted)
        throw std::invalid_argument(
            "the state is of another scene, or of one that was edited otherwise");
    return state;
}

template <class Io, class List>
void each_number_of_pairs(Io& io, List& pairs) {
    io.count(pairs);
    for (auto& pair : pairs) io(pair.first), io(pair.second);
}

/// The keys of one sorted list that the other lacks, each once.
Keys beyond(const Keys& keys, const Keys& others) {
    Keys left;
    for (const std::uint64_t key : keys)
        if (!std::binary_search(others.begin(), others.end(), key) &&
            (left.empty() || left.back() != key))
            left.push_back(key);
    return left;
}

/// Lets pairs meet again, or keeps them apart; all or, where the collider refuses one, none.
void exclude_all(Proximity& proximity, const World& world, const Keys& keys, bool excluded,
                 const std::string& collider) {
    std::size_t done = 0;
    try {
        for (; done < keys.size(); ++done)
            exclude_pair(proximity, world, keys[done], excluded, collider);
    } catch (...) {
        while (done-- > 0) exclude_pair(proximity, world, keys[done], !excluded, collider);
        throw;
    }
}

}  // namespace

void Simulation::Parts::exclude_only(std::vector<std::uint64_t> keys) {
    if (filled) {
        const Keys freed = beyond(world.excluded, keys);
        exclude_all(proximity, world, freed, false, collider_name);
        try {
            exclude_all(proximity, world, beyond(keys, world.excluded), true, collider_name);
        } catch (...) {
            exclude_all(proximity, world, freed, true, collider_name);
            throw;
        }
    }
    world.excluded = std::move(keys);
}

void Simulation::Parts::renew_at(const std::vector<std::uint8_t>& broken_then) {
    std::vector<Joint>& joints = world.joints.joints;
    std::vector<std::uint8_t> broken_now;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        broken_now.push_back(joints[i].broken);
        joints[i].broken = broken_then[i] != 0;
    }
    outdated = true;
    renew();
    stepper.solver = make_row_solver(world, stepper.plan, stepper.workers);
    for (std::size_t i = 0; i < joints.size(); ++i) joints[i].broken = broken_now[i] != 0;
}

std::string Simulation::save() const {
    Parts& p = *parts_;
    p.renew();
    std::string state;
    StateWriter writer(state);
    each_number_of_list(writer, p.world.excluded);
    each_number_of_list(writer, p.broken);
    write_state(p.world, writer);
    each_number_of_pairs(writer,
                         p.record ? p.record->touching() : std::vector<ContactRecord::Pair>());

    std::string bytes(kMagic);
    put(bytes, kStateVersion);
    put(bytes, foundation(p.world, p.assets.geometries));
    put(bytes, static_cast<std::uint64_t>(state.size()));
    put(bytes, hash_of(state));
    return bytes + state;
}

void Simulation::restore(std::string_view bytes) {
    Parts& p = *parts_;
    StateReader reader(state_in(bytes, foundation(p.world, p.assets.geometries)));
    Keys excluded;
    std::vector<std::uint8_t> broken;
    each_number_of_list(reader, excluded);
    each_number_of_list(reader, broken);
    p.exclude_only(std::move(excluded));
    read_state(p.world, reader);
    p.renew_at(broken);
    p.placed = false;
    p.residual = {};
    std::vector<ContactRecord::Pair> touching;
    each_number_of_pairs(reader, touching);
    if (p.record) p.record->start_from(std::move(touching));
}

}  // namespace plumb
