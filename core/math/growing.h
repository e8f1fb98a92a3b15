// SPDX-License-Identifier: MIT
/// Vectors that are sized again and again, as what they hold comes and goes: whenever one has to
/// grow, it takes room for half as much again, so that soon it need not any more.
#pragma once

#include <cstddef>
#include <vector>

namespace plumb {

/// Room for n values; the first time for no more than them.
template <class T>
void make_room(std::vector<T>& v, std::size_t n) {
    if (n > v.capacity()) v.reserve(v.capacity() == 0 ? n : n + n / 2);
}

/// v has n values; new numbers are 0, new vectors and matrices undefined.
template <class T>
void size_anew(std::vector<T>& v, std::size_t n) {
    make_room(v, n);
    v.resize(n);
}

/// v has n values, all of them `value`.
template <class T>
void fill_anew(std::vector<T>& v, std::size_t n, const T& value) {
    make_room(v, n);
    v.assign(n, value);
}

/// v has the values of `more` behind its own.
template <class T>
void append(std::vector<T>& v, const std::vector<T>& more) {
    make_room(v, v.size() + more.size());
    v.insert(v.end(), more.begin(), more.end());
}

/// v has the values of `from`.
template <class T>
void copy_anew(std::vector<T>& v, const std::vector<T>& from) {
    make_room(v, from.size());
    v.assign(from.begin(), from.end());
}

}  // namespace plumb
