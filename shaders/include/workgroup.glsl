// Numbers of this workgroup and of this invocation, in a dispatch that is folded into rows of 32,768 workgroups: see `groups`
// in groups.glsl.
#ifndef WORKGROUP_GLSL
#define WORKGROUP_GLSL

uint workgroup_number() { return gl_WorkGroupID.x + gl_WorkGroupID.y * 32768u; }

// The number of this invocation, if workgroups have 64 invocations.
uint invocation_number() { return gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * 32768u * 64u; }

#endif
