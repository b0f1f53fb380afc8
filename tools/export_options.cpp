// The options of export, the same in its own command and in `build`.
#include "stages/export/export.h"
#include "tools/command_line.h"
#include "tools/stage_options.h"

namespace lozenge {

void add_level_options(Options& options, const std::string& samples, ExportOptions& level) {
  options.group("Level of detail");
  options.samples(samples + " N", level.samples,
                  "Samples a side of each patch in the asset, 2^k + 1; without it, all of the geometry image");
  options.number("--triangles BUDGET", level.triangle_budget, {1},
                 "At most this many triangles, or as few as there can be");
}

void add_export_options(Options& options, ExportOptions& asset) {
  options.group("Asset");
  options.number(
      "--lods N", asset.max_coarser_levels, {0, 10},
      "At most this many coarser levels of detail in the asset, each of about a quarter of the triangles of the "
      "one before; without it, as many as there are down to some hundred triangles");
  options
      .one_of("--normal-bits N", asset.textures.normal_bits, {8, 16},
              "Bits a channel of the normal map in the asset: 8 or 16")
      .shows_default();
  options.choice(
      "--vertex-format NAME", asset.vertex_format,
      Words<VertexFormat>{{"float", VertexFormat::kFloat}, {"quantized", VertexFormat::kQuantized}},
      "float; or quantized, integers of 8 and 16 bits (KHR_mesh_quantization): less than half the size [float]");
  options.choice("--compress NAME", asset.compression,
                 Words<Compression>{{"none", Compression::kNone}, {"meshopt", Compression::kMeshopt}},
                 "none; or meshopt, vertices and triangles compressed without loss (EXT_meshopt_compression) [none]");
  options.choice(
      "--texture-format NAME", asset.textures.format,
      Words<TextureFormat>{{"png", TextureFormat::kPng},
                           {"jpeg", TextureFormat::kJpeg},
                           {"webp", TextureFormat::kWebp},
                           {"ktx2", TextureFormat::kKtx2},
                           {"basisu", TextureFormat::kBasisu}},
      "Of the textures in the asset: png, jpeg, or webp (by EXT_texture_webp); normals and what has alpha "
      "are png always; ktx2: png there, and with `build` as with --ktx2 beside it; basisu: with `build` also "
      "NAME.basisu.glb, with UASTC of these (KHR_texture_basisu), by node and npm's ktx2-encoder [png]");
  options.number("--texture-quality N", asset.textures.quality, {1, 100}, "Of jpeg and webp").shows_default();
  options.choice("--finest NAME", asset.finest,
                 Words<Finest>{{"auto", Finest::kAuto}, {"source", Finest::kSource}, {"samples", Finest::kSamples}},
                 "The finest level: source, the source's own triangles cut to the patches; samples; auto, the source's "
                 "where they are no more and known [auto]");
  options.choice("--caps NAME", asset.caps, Words<Caps>{{"keep", Caps::kKeep}, {"open", Caps::kOpen}},
                 "keep: what fills holes is part of the asset; open: it is left out [keep]");
  options.choice(
      "--lods-as NAME", asset.lods_as,
      Words<LodsAs>{{"msft_lod", LodsAs::kMsftLod}, {"nodes", LodsAs::kNodes}, {"files", LodsAs::kFiles}},
      "Coarser levels are msft_lod, alternatives of the nodes that show the finest (extension MSFT_lod); nodes, its "
      "siblings NAME_LOD0, NAME_LOD1, ...; files of their own, NAME.lod1.glb, NAME.lod2.glb, ... [msft_lod]");
  options.choice(
      "--lod-maps NAME", asset.level_maps,
      Words<LevelMapsOf>{{"own", LevelMapsOf::kLevels}, {"shared", LevelMapsOf::kAsset}},
      "Of levels that are fitted to the source: own, each sees the source's colours from its own surface, in "
      "maps of half the side of the level before; shared, those of the finest, but for normals [own]");
  options.flag("--separate-lods", asset.separate_files, "Also each coarser level of detail as a file of its own");
}

}  // namespace lozenge
