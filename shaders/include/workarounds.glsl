// Behaviour of drivers that shaders work around. Each entry names the driver, the versions with which it was observed, and the
// cost that justifies the workaround. docs/decisions.md, "What CPU drivers taught", has the measurements. Shaders refer to an
// entry by its name.
//
// MOST_TRIPS (llvmpipe, Mesa 22.3.6 and 25.0.7): the driver silently ends all loops of an invocation after 65,535 trips in all.
//   Loops whose length depends on the scene count their trips in `trips`. A cell that needs more than MOST_TRIPS is abandoned and
//   counted as COUNTER_STALLED, and the frame is made again with kernels that take fewer trips. The difference to 65,535 is for
//   loops of fixed length.
// DO_WHILE (llvmpipe, Mesa 22.3.6): a loop that tests its condition first runs its body once more than needed, with all
//   invocations masked, since the driver does not skip masked code. So loops test at their end, and guard what must not happen
//   if there is nothing to do. `thin` of DutchShip, 480 x 270: 6.1 ms with conditions first, 5.0 ms so. Loops over lists
//   of layers (`composite`, `points`) are exceptions: after a do-while loop, invocations that left it early would see
//   what later trips made of the variables of the body.
// BOUND_TWICE (llvmpipe, Mesa 22.3.6): texel buffers are faster to read, storage buffers faster to write. Data that one pass writes
//   and others read has two bindings. The name of the second one ends in `_out`. With storage buffers alone, `resolve` of
//   FlightHelmet, 480 x 270, 64 samples, takes 6.6 ms instead of 4.5, and `sample` 35.9 instead of 33.8.
// UNROLLED (llvmpipe, Mesa 25.0.7): the driver does not unroll a loop that contains another loop, whatever the shader asks for,
//   and indexes the arrays of its body in memory. The steps of such a loop are therefore written out. `sample` of DutchShip,
//   640 x 360, 256 samples: 205 ms as a loop, 100 ms written out; 75 ms either way with Mesa 22.3.6. The driver unrolls only
//   loops that count up to a literal by additions; others are marked [[unroll]], which shaderc obeys.
// ROLLED (llvmpipe, Mesa 22.3.6): a loop of few trips with a long body takes long to compile if the driver unrolls it: the six
//   rows of `detect` 200 ms instead of 78 ms, the nine neighbours of `seen_beside` 90 ms instead of 56 ms. Such loops are do-while
//   loops over a variable, which the driver does not unroll.
// REASSOCIATED (llvmpipe, Mesa 22.3.6): the driver computes a * x + b * y + c as a * x + (b * y + c) in some copies that it makes
//   of a loop's body, though the sum is `precise`. Which copy a candidate gets depends on the order of its list, so that samples
//   on an edge differed from run to run. So the first sum is converted to an integer and combined with bits that are always 0,
//   which the driver can't know.
// STAYS_BOUND (llvmpipe, Mesa 22.3.6): the driver compiles a kernel again, with the values of uniform blocks, where these were
//   bound since the last dispatch. So uniform blocks have a descriptor set of their own, which stays bound. 600 views of
//   assets/letters.glb: 66 s with one set for all data, 1.4 s so.
// SHUFFLE (llvmpipe, Mesa 22.3.6): subgroupBroadcast is a loop, subgroupShuffle one instruction. So shaders shuffle. `sample` of
//   DutchShip, 480 x 270, 64 samples: 75 ms with broadcasts in `sample_lines`, 37 ms with shuffles.
// SHUFFLES_ALONE (NVIDIA 580.159.04): where a kernel that was optimised by ssa-rewrite of spirv-opt exchanges data by built-in reductions and
//   scans of subgroups within loops, the driver loses some of it, in other places in each run. `sample_lines` with subgroups of 32 lost
//   candidates of 1,291 of 9,241 cells of SauerbratenZdm2. So teams (team.glsl) exchange data by shuffles alone, and so
//   do invocations that append to a list (append.glsl).
#ifndef WORKAROUNDS_GLSL
#define WORKAROUNDS_GLSL

// Trips of an invocation's loops after which a cell is abandoned.
#define MOST_TRIPS 50000u

#endif
