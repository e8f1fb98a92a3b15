// SPDX-License-Identifier: MIT
#include "math/least_degree.h"

#include "math/growing.h"

#include <algorithm>
#include <cmath>

namespace plumb {
namespace {

constexpr std::uint32_t kNobody = ~0u;

/// A row with more neighbours than this comes last: to follow it would take too long.
std::int64_t most_neighbours(std::uint32_t rows) {
    constexpr std::int64_t kFew = 16;
    constexpr double kOfRoot = 10;
    return std::min(std::int64_t(rows) - 2,
                    std::max(kFew, static_cast<std::int64_t>(kOfRoot * std::sqrt(double(rows)))));
}

}  // namespace

void LeastDegree::find(const RowGraph& graph, std::vector<std::uint32_t>& order) {
    begin(graph);
    while (eliminated_ < rows_) {
        const std::uint32_t pivot = take_least();
        make_element(pivot);
        count_outside(pivot);
        update_rows(pivot);
        join_alike(pivot);
        put_back(pivot);
    }
    list_order(order);
}

void LeastDegree::begin(const RowGraph& graph) {
    rows_ = graph.rows();
    eliminated_ = least_ = marks_ = 0;
    copy_anew(list_, graph.list());
    room_ = 2 * list_.size() + rows_;
    fill_anew(head_, rows_ + 1, kNobody);
    fill_anew(bucket_, rows_, kNobody);
    const Node alone{0, 0, 0, 1, 0, kNobody, kNobody, kNobody, kNobody, 0, kNobody, 0, 0};
    fill_anew(nodes_, rows_ + 1, alone);
    const std::int64_t most = most_neighbours(rows_);
    for (std::uint32_t i = 0; i < rows_; ++i) {
        Node& row = nodes_[i];
        row.first = graph.first()[i], row.length = graph.first()[i + 1] - row.first;
        // as long as no neighbour was eliminated, it counts itself
        const std::uint32_t degree = row.length + 1;
        if (row.length > 0 && degree <= most) {
            link(i, degree);
            continue;
        }
        ++eliminated_;
        if (row.length > 0) row.weight = 0, row.parent = rows_;
    }
}

std::uint32_t LeastDegree::take_least() {
    while (head_[least_] == kNobody) ++least_;
    const std::uint32_t pivot = head_[least_];
    unlink(pivot);
    return pivot;
}

/// The rows of all elements that the pivot was in, and its neighbours.
void LeastDegree::make_element(std::uint32_t pivot) {
    if (list_.size() + least_ > room_) compact();
    Node& element = nodes_[pivot];
    eliminated_ += element.weight;
    element.joined = pivot;
    element.degree = 0;
    const auto begin = static_cast<std::uint32_t>(list_.size());
    const auto join = [&](std::uint32_t first, std::uint32_t last) {
        for (std::uint32_t k = first; k < last; ++k) {
            const std::uint32_t i = list_[k];
            Node& row = nodes_[i];
            if (is_within(row, pivot)) continue;
            row.joined = pivot;
            element.degree += row.weight;
            unlink(i);
            list_.push_back(i);
        }
    };
    for (std::uint32_t k = 0; k < element.elements; ++k) {
        Node& within = nodes_[list_[element.first + k]];
        join(within.first, within.first + within.length);
        within.parent = pivot;
    }
    join(element.first + element.elements, element.first + element.length);
    element.first = begin;
    element.length = static_cast<std::uint32_t>(list_.size()) - begin;
}

/// Of the other elements of its rows, what is not in the new one.
void LeastDegree::count_outside(std::uint32_t pivot) {
    for (const std::uint32_t i : list_of(nodes_[pivot])) {
        const Node& row = nodes_[i];
        for (const std::uint32_t e : list_of(row).first(row.elements)) {
            Node& element = nodes_[e];
            if (element.parent != kNobody) continue;
            if (element.counted != pivot) element.counted = pivot, element.outside = element.degree;
            element.outside -= row.weight;
        }
    }
}

void LeastDegree::update_rows(std::uint32_t pivot) {
    for (const std::uint32_t i : list_of(nodes_[pivot])) update_row(i, pivot);
}

/// The new element takes the place of what it absorbs, and its rows are neighbours by it alone.
void LeastDegree::update_row(std::uint32_t at, std::uint32_t pivot) {
    Node &row = nodes_[at], &element = nodes_[pivot];
    const std::span<std::uint32_t> list = list_of(row);
    std::uint32_t size = 0, degree = 0, hash = 0;
    for (const std::uint32_t e : list.first(row.elements)) {
        Node& other = nodes_[e];
        if (other.parent != kNobody) continue;
        if (other.outside == 0) {
            other.parent = pivot;
            continue;
        }
        degree += other.outside, hash += e;
        list[size++] = e;
    }
    const std::uint32_t elements = size;
    for (const std::uint32_t j : list.subspan(row.elements)) {
        if (is_within(nodes_[j], pivot)) continue;
        degree += nodes_[j].weight, hash += j;
        list[size++] = j;
    }
    if (degree == 0) {  // it has nobody else, and is eliminated at once
        element.degree -= row.weight;
        element.weight += row.weight;
        eliminated_ += row.weight;
        row.weight = 0, row.parent = pivot;
        return;
    }
    // there is room: the pivot, or an element that it absorbed, is no longer in the list
    list_[row.first + size] = list[elements];
    list[elements] = list[0];
    list[0] = pivot;
    row.elements = elements + 1, row.length = size + 1;
    row.degree = std::min(row.degree, degree);
    row.hash = hash % rows_;
    row.next = bucket_[row.hash];
    bucket_[row.hash] = at;
}

/// Rows of the same elements and neighbours are eliminated together: the last one stands for them.
void LeastDegree::join_alike(std::uint32_t pivot) {
    for (const std::uint32_t i : list_of(nodes_[pivot])) {
        if (nodes_[i].weight == 0) continue;
        std::uint32_t& first = bucket_[nodes_[i].hash];
        for (std::uint32_t at = first; at != kNobody; at = nodes_[at].next) join_those_like(at);
        first = kNobody;
    }
}

/// Of those behind it in its bucket.
void LeastDegree::join_those_like(std::uint32_t at) {
    Node& row = nodes_[at];
    if (row.next == kNobody) return;
    ++marks_;
    for (const std::uint32_t k : list_of(row)) nodes_[k].mark = marks_;
    std::uint32_t last = at;
    for (std::uint32_t j = row.next; j != kNobody; j = nodes_[j].next) {
        Node& other = nodes_[j];
        const std::span<const std::uint32_t> list = list_of(other);
        const bool alike =
            other.length == row.length && other.elements == row.elements &&
            std::ranges::all_of(list, [&](std::uint32_t k) { return nodes_[k].mark == marks_; });
        if (!alike) {
            last = j;
            continue;
        }
        row.weight += other.weight;
        other.weight = 0, other.parent = at;
        nodes_[last].next = other.next;
    }
}

/// Into the lists of their degrees.
void LeastDegree::put_back(std::uint32_t pivot) {
    Node& element = nodes_[pivot];
    std::uint32_t size = 0;
    const std::span<std::uint32_t> list = list_of(element);
    for (const std::uint32_t i : list) {
        const Node& row = nodes_[i];
        if (row.weight == 0) continue;
        link(i, std::min(row.degree + element.degree, rows_ - eliminated_) - row.weight);
        list[size++] = i;
    }
    element.elements = 0, element.length = size;
    list_.resize(element.first + size);
}

/// What was absorbed comes right before what absorbed it, elements before rows.
void LeastDegree::list_order(std::vector<std::uint32_t>& order) {
    std::fill(head_.begin(), head_.end(), kNobody);
    for (const bool rows : {true, false})
        for (std::uint32_t i = rows_; i-- > 0;) {
            Node& node = nodes_[i];
            if (node.parent == kNobody || (node.weight == 0) != rows) continue;
            node.next = head_[node.parent];
            head_[node.parent] = i;
        }
    order.clear();
    for (std::uint32_t root = 0; root <= rows_; ++root) {
        if (nodes_[root].parent != kNobody) continue;
        open_.push_back(root);
        while (!open_.empty()) {
            const std::uint32_t at = open_.back(), child = head_[at];
            if (child != kNobody) {
                head_[at] = nodes_[child].next;
                open_.push_back(child);
                continue;
            }
            open_.pop_back();
            if (at != rows_) order.push_back(at);
        }
    }
}

void LeastDegree::link(std::uint32_t at, std::uint32_t degree) {
    Node& row = nodes_[at];
    row.degree = degree;
    row.previous = kNobody, row.next = head_[degree];
    if (row.next != kNobody) nodes_[row.next].previous = at;
    head_[degree] = at;
    least_ = std::min(least_, degree);
}

void LeastDegree::unlink(std::uint32_t at) {
    const Node& row = nodes_[at];
    if (row.next != kNobody) nodes_[row.next].previous = row.previous;
    (row.previous != kNobody ? nodes_[row.previous].next : head_[row.degree]) = row.next;
}

/// Without the lists of what was absorbed.
void LeastDegree::compact() {
    compact_.clear();
    for (Node& node : nodes_) {
        if (node.parent != kNobody) continue;
        const std::span<const std::uint32_t> list = list_of(node);
        node.first = static_cast<std::uint32_t>(compact_.size());
        compact_.insert(compact_.end(), list.begin(), list.end());
    }
    std::swap(list_, compact_);
    room_ = std::max(room_, 2 * (list_.size() + least_));
}

}  // namespace plumb
