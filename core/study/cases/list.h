// SPDX-License-Identifier: MIT
/// The functions that make the cases; cases.cpp names them.
#pragma once

#include "study/subject.h"

namespace plumb::study {

Subject pendulum();

}  // namespace plumb::study
