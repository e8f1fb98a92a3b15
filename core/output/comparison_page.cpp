// SPDX-License-Identifier: MIT
#include "output/comparison_page.h"

#include "output/deflate.h"
#include "output/html_json.h"
#include "output/html_page.h"

namespace plumb {

std::string comparison_page(const std::string& title, std::string_view comparison,
                            const std::vector<const Geometry*>& geometries) {
    const ShapeTexts texts = shape_texts(geometries);
    return page_head(title) +
           data_element("plumb-comparison", "application/json", without_tags(comparison)) +
           data_element("plumb-shapes", "application/json", texts.shapes) +
           data_element("plumb-meshes", "text/plain", base64(deflated(texts.meshes))) + page_end();
}

}  // namespace plumb
