// The implementation of tinygltf, compiled once. Images are neither decoded nor looked for: their bytes are the
// business of who needs them.
#define TINYGLTF_IMPLEMENTATION
#include <tiny_gltf.h>
