// What drivers make shaders do. Each entry names the driver, the version that showed it, and the figure that asks for it;
// docs/decisions.md, "What CPU drivers taught", has the measurements. Shaders point here by the name of an entry.
//
// MOST_TRIPS (llvmpipe, Mesa 22.3.6 and 25.0.7): the driver ends all loops of an invocation, in silence, after 65,535 trips in all.
//   Loops whose length a scene decides count their trips in `trips`. A cell that needs more than MOST_TRIPS is left, counted as
//   COUNTER_STALLED, and sampled by a kernel that has fewer trips to make. The rest up to 65,535 is for loops of fixed length.
// DO_WHILE (llvmpipe, Mesa 22.3.6): a loop that tests its condition first runs its body once more than it has trips, with all
//   invocations masked, since a branch skips nothing. So loops test at their end, and guard what the first trip may not do.
//   An exception are loops after which invocations that left early read a variable of the body: these see what later trips make
//   of it (`composite`).
// BOUND_TWICE (llvmpipe, Mesa 22.3.6): texel buffers are faster to read, storage buffers faster to write. Data that one pass writes
//   and others read has two bindings, of which the second one ends in `_out`.
// UNROLLED (llvmpipe, Mesa 25.0.7): the driver leaves a loop rolled that is around another loop, whatever the shader asks for, and
//   indexes the arrays of its body in memory. Each step of such a loop is written out. `sample` of DutchShip, 640 x 360, 256 samples:
//   205 ms rolled, 100 ms written out; 75 ms either way with Mesa 22.3.6. Loops are unrolled only if they count by adding up to a
//   literal; others are marked [[unroll]], which shaderc obeys.
// ROLLED (llvmpipe, Mesa 22.3.6): a loop of few trips and a long body takes the driver long to compile if it is unrolled: the six
//   rows of `detect` 200 ms instead of 78 ms, the nine neighbours of `seen_beside` 90 ms instead of 56 ms. Such loops are do-while
//   loops over a variable, which the driver does not unroll.
// REASSOCIATED (llvmpipe, Mesa 22.3.6): the driver computes a * x + b * y + c as a * x + (b * y + c) in some copies that it makes
//   of a loop's body, though the sum is `precise`. Which copy a candidate gets depends on the order of its list, so that samples
//   on an edge differed from run to run. The first sum passes through integers, with bits that are 0 and that the driver does not know.
// SHUFFLE (llvmpipe, Mesa 22.3.6): subgroupBroadcast is a loop, subgroupShuffle one instruction. Shaders shuffle.
#ifndef WORKAROUNDS_GLSL
#define WORKAROUNDS_GLSL

// Trips of an invocation's loops after which a cell is left.
#define MOST_TRIPS 50000u

#endif
