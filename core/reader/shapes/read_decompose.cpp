// SPDX-License-Identifier: MIT
#include "reader/shapes/read_decompose.h"

namespace plumb::reader {

namespace {

const Table<DecomposeOptions>& decompose_table() {
    using D = DecomposeOptions;
    static const Table<D> table = {
        field<D>("excess", Number{{1e-6, 1}}, &D::excess,
                 "cut until the hulls exceed the mesh's volume by no more than this share of it"),
        field<D>("max_parts", Whole<std::uint32_t>{{1, 1024}}, &D::max_parts,
                 "no more cuts when there are so many parts"),
    };
    return table;
}

}  // namespace

void read_decompose(DecomposeOptions& options, const Node& node) {
    if (node.json().is_boolean()) return;
    if (!node.json().is_object()) node.fail_wanting("true, false or an object with options");
    read_object(options, node, decompose_table());
}

SchemaJson decompose_schema() {
    return {{"anyOf", {{{"type", "boolean"}}, object_schema(decompose_table())}}};
}

}  // namespace plumb::reader
