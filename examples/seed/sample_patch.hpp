// The bicubic patch on which the examples look at everything: a square bent up and down in turns.
#pragma once

#include "patch.hpp"

namespace seed {

inline Net sample_patch() {
  return {3,
          3,
          {{-2, 2, 1},
           {-1, 3, -1},
           {1, 3, 1},
           {2, 2, -1},
           {-1.5, 1, 1},
           {-0.5, 1.5, -1},
           {1.5, 1.5, 1},
           {2.5, 1, -1},
           {-2.5, -1, 1},
           {-1.5, -0.5, -1},
           {0.5, -0.5, 1},
           {1.5, -1, -1},
           {-2, -2, 1},
           {-1, -1, -1},
           {1, -1, 1},
           {2, -2, -1}}};
}

} // namespace seed
