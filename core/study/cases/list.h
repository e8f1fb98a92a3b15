// SPDX-License-Identifier: MIT
/// The functions that make the cases; cases.cpp names them.
#pragma once

#include "study/subject.h"

namespace plumb::study {

Subject parabola();

Subject free_top();
Subject dzhanibekov();
Subject gyroscope();

Subject pendulum();
Subject double_pendulum();

Subject slope_slides();
Subject slope_sticks();
Subject braking();

Subject rolling_start();
Subject rolling_down();
Subject rolling_disk();

Subject bouncing();
Subject cradle();

Subject stack();
Subject loaded_stack();
Subject tower();

Subject arch();
Subject wall();

Subject robot();

Subject pile();

Subject catenary();
Subject hanging_chain();
Subject heavy_chain();

Subject gears();
Subject springs();

Subject hanging_strip();
Subject drape();
Subject drape_of(std::uint32_t cells, std::uint32_t substeps);  ///< the same in a mesh of cells²

Subject rope_catenary();
Subject hanging_rope();

Subject cantilever();
Subject cantilever_of(std::uint32_t across);  ///< the same with so many cells across

Subject balloon();
Subject pressed_balloon();

}  // namespace plumb::study
