// SPDX-License-Identifier: MIT
#include "output/png.h"

#include <new>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

namespace plumb {

std::string png_bytes(const Picture& picture) {
    std::string bytes;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                                   static_cast<std::size_t>(size));
    };
    const int done = stbi_write_png_to_func(append, &bytes, picture.width, picture.height, 3,
                                            picture.rgb.data(), 3 * picture.width);
    if (!done) throw std::bad_alloc();  // its only way to fail when nothing is written to disk
    return bytes;
}

void PngExporter::finish() {
    file_.append(png_bytes(draw_picture(header_, last_)));
    file_.commit();
}

}  // namespace plumb
