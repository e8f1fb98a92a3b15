// SPDX-License-Identifier: MIT
#include "output/study_page.h"

#include "output/charts.h"
#include "output/html_page.h"

namespace plumb {

std::string study_page(const std::string& title, std::string_view study_json) {
    return page_head(title) +
           data_element("plumb-study", "application/json", without_tags(study_json)) +
           page_end(charts_script());
}

}  // namespace plumb
