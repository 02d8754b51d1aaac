// Many bodies: seconds and memory of walls, which grow with their size.
#pragma once

namespace mortise::bench {

/// A row for each wall of 5 x 5 blocks, 10 x 10, ... up to `largest`: sizes, seconds a stage, peak memory.
void print_walls(int largest);

}  // namespace mortise::bench
