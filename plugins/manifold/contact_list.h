// SPDX-License-Identifier: MIT
/// Contacts of one `detect`, on their way to the core: numbered, made unique, sorted and handed
/// over.
#pragma once

#include "manifold/body_table.h"

#include <initializer_list>
#include <vector>

namespace plumb {

/// A 64-bit key of some small numbers, never 0.
std::uint64_t feature_key(std::initializer_list<std::uint64_t> ids);

class ContactList {
public:
    void clear() { contacts_.clear(); }

    /// Room for one contact of two parts; ids and parts are filled in, the caller fills the rest.
    Contact& add(const Part& a, const Part& b);

    /// The same for a particle and a part.
    Contact& add_particle(std::uint32_t particle, const Part& b);

    /// One contact that is complete.
    void push(const Contact& contact) { contacts_.push_back(contact); }

    auto begin() const { return contacts_.begin(); }
    auto end() const { return contacts_.end(); }
    std::size_t size() const { return contacts_.size(); }
    Contact* data() { return contacts_.data(); }
    void shrink(std::size_t count) { contacts_.resize(count); }

    /// Sorts by (a, b, feature) and makes features unique within a pair, but for 0.
    void finish();

    /// Hands all contacts to a sink.
    Status write_to(const ContactSink& sink) const;

    /// How many pairs of bodies have a contact. After `finish`.
    std::uint64_t pair_count() const;

private:
    std::vector<Contact> contacts_;
};

/// The worse of two results; the first where they are alike.
inline Status worse_of(const Status& a, const Status& b) { return b.code > a.code ? b : a; }

}  // namespace plumb
