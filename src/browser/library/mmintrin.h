#pragma once
// Eigen reads this header of the processor's oldest vectors before those it uses. A browser has only the later ones.
