#include "server/command_line.h"

#include <pmmintrin.h>
#include <xmmintrin.h>

int main(int count, char** arguments) {
    // Numbers too small to be normal are taken as 0, as Embree wants it. Threads inherit this from
    // the one that makes them, so it comes before any is made.
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    return patchlight::server::run_command_line(count, arguments);
}
