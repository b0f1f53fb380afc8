// OpenImageIO, to be included instead of its own headers. These bring a second copy of fmt, header-only and without
// exceptions, which would stand in for the library's in whatever is linked with the object.
#pragma once

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/printf.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
