# cmake -DFROM=blue_noise.bin -DNAME=blue_noise_draws -DTO=blue_noise_draws.cpp -P EmbedBlueNoise.cmake
# Ranks of 16 bits, low byte first, become draws of 24 bits: rank 0x1234 is 0x123480, (rank + 1/2) * 256.
file(READ "${FROM}" ranks HEX)
string(REGEX REPLACE "(..)(..)" "0x\\2\\180," draws "${ranks}")
string(REPEAT "........." 12 line)
string(REGEX REPLACE "(${line})" "\\1\n" draws "${draws}")
file(WRITE "${TO}" "// Made from ${FROM}.
#include \"voxel/blue_noise.h\"
const uint32_t ombre::voxel::${NAME}[65536] = {
${draws}};
")
