#pragma once

namespace hbvm {

/// "0.1.0", with the commit it was built from where that is known: "0.1.0+g1a2b3c4".
const char* version();

}  // namespace hbvm
