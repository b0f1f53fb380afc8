#include "formats/files/exr_fixtures.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfMultiPartInputFile.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfTiledInputPart.h>
#include <ImfTiledOutputPart.h>

#include <fstream>
#include <iterator>
#include <random>

namespace lozenge::fixtures {

namespace {

std::size_t width_of(const Imf::Header& h) { return static_cast<std::size_t>(h.dataWindow().max.x) + 1; }
std::size_t pixels_of(const Imf::Header& h) {
  return width_of(h) * (static_cast<std::size_t>(h.dataWindow().max.y) + 1);
}

/// Slices for the part's channels, which are made where they are missing.
Imf::FrameBuffer frame_of(ExrPart& part) {
  Imf::FrameBuffer frame;
  std::size_t n = 0;
  for (auto c = part.header.channels().begin(); c != part.header.channels().end(); ++c, ++n) {
    if (part.channels.size() <= n) part.channels.emplace_back();
    part.channels[n].resize(pixels_of(part.header));
    frame.insert(c.name(), Imf::Slice(c.channel().type, reinterpret_cast<char*>(part.channels[n].data()),
                                      sizeof(std::uint32_t), sizeof(std::uint32_t) * width_of(part.header)));
  }
  return frame;
}

}  // namespace

void remove_attribute(Imf::Header& header, const std::string& name) {
  Imf::Header kept;
  for (auto a = header.begin(); a != header.end(); ++a) {
    if (name != a.name()) kept.insert(a.name(), a.attribute());
  }
  header = kept;
}

void rewrite_exr(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::function<void(std::vector<ExrPart>&)>& change) {
  std::vector<ExrPart> parts;
  {
    Imf::MultiPartInputFile in(from.c_str());
    for (int p = 0; p < in.parts(); ++p) {
      parts.push_back({in.header(p), {}});
      Imf::TiledInputPart part(in, p);
      part.setFrameBuffer(frame_of(parts.back()));
      part.readTiles(0, part.numXTiles() - 1, 0, part.numYTiles() - 1);
    }
  }
  change(parts);
  std::vector<Imf::Header> headers;
  for (const ExrPart& part : parts) headers.push_back(part.header);
  Imf::MultiPartOutputFile out(to.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (std::size_t p = 0; p < parts.size(); ++p) {
    Imf::TiledOutputPart part(out, static_cast<int>(p));
    part.setFrameBuffer(frame_of(parts[p]));
    part.writeTiles(0, part.numXTiles() - 1, 0, part.numYTiles() - 1);
  }
}

}  // namespace lozenge::fixtures
