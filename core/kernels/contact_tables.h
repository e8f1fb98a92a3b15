// SPDX-License-Identifier: MIT
/// The tables of contact kernels. Included by the units of each instruction set and by nothing
/// else.
#pragma once

#include "kernels/contact_passes.h"
#include "kernels/contact_residuals.h"

#include <array>

namespace plumb::kernels {

template <class Real, int W, ContactVariant V>
constexpr ContactKernels<Real, W> kernels_of() {
    return {take_masses<Real, W>,
            prepare<Real, W, V>,
            begin<Real, W, V>,
            warm_start<Real, W, V>,
            solve<Pass::velocity, Real, W, V>,
            solve<Pass::position, Real, W, V>,
            find_residuals<Real, W, V>};
}

/// All variants of one precision and width, indexed by ContactVariant.
template <class Real, int W>
constexpr std::array<ContactKernels<Real, W>, kContactVariants> all_contact_kernels() {
    return {kernels_of<Real, W, ContactVariant::frictionless>(),
            kernels_of<Real, W, ContactVariant::friction>(),
            kernels_of<Real, W, ContactVariant::rolling>()};
}

}  // namespace plumb::kernels
