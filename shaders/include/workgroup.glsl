// Which workgroup and which invocation this is, of a dispatch that is folded into rows of 32,768 workgroups: see `groups` in
// groups.glsl.
#ifndef WORKGROUP_GLSL
#define WORKGROUP_GLSL

uint workgroup_number() { return gl_WorkGroupID.x + gl_WorkGroupID.y * 32768u; }

// In workgroups of 64 invocations.
uint invocation_number() { return gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 32768u * 64u; }

#endif
