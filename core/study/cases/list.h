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

Subject bouncing();
Subject cradle();

Subject stack();

Subject catenary();
Subject hanging_chain();
Subject heavy_chain();

Subject gears();
Subject springs();

}  // namespace plumb::study
