#!/usr/bin/env python3
"""Compiles a compute shader in Slang with the compiler of the package slangpy, and compares its descriptor set with that of a
shader in GLSL.

    compile.py SHADER.slang INCLUDES OUT.spv REFERENCE.spv
"""
import ctypes
import importlib.util
import pathlib
import struct
import sys

SPIRV, SLANG, COMPUTE, DIRECTLY = 6, 1, 6, 1 << 10  # constants of slang.h: target, language, stage, flag
SET, VERSION = 0, 2046  # the library's descriptor set, and the constant with the version of the interface
SPEC_ID, NON_WRITABLE, BINDING, DESCRIPTOR_SET, ARRAY_STRIDE, OFFSET = 1, 24, 33, 34, 6, 35


def compiled(source: str, includes: str) -> bytes:
    """SPIR-V of the entry point `main`."""
    folder = pathlib.Path(importlib.util.find_spec("slangpy").origin).parent
    library = ctypes.CDLL(str(next(folder.glob("libslang-compiler.so*"))))
    pointer, number, text = ctypes.c_void_p, ctypes.c_int, ctypes.c_char_p

    def call(name, result, *arguments):
        function = getattr(library, name)
        function.restype, function.argtypes = result, [kind for kind, _ in arguments]
        return function(*(value for _, value in arguments))

    session = call("spCreateSession", pointer, (text, None))
    request = (pointer, call("spCreateCompileRequest", pointer, (pointer, session)))
    target = (number, call("spAddCodeGenTarget", number, request, (number, SPIRV)))
    profile = call("spFindProfile", ctypes.c_uint, (pointer, session), (text, b"spirv_1_5"))
    call("spSetTargetProfile", None, request, target, (ctypes.c_uint, profile))
    call("spSetTargetFlags", None, request, target, (ctypes.c_uint, DIRECTLY))
    call("spAddSearchPath", None, request, (text, includes.encode()))
    unit = (number, call("spAddTranslationUnit", number, request, (number, SLANG), (text, b"main")))
    call("spAddTranslationUnitSourceFile", None, request, unit, (text, source.encode()))
    entry = (number, call("spAddEntryPoint", number, request, unit, (text, b"main"), (number, COMPUTE)))
    failed = call("spCompile", number, request)
    sys.stderr.write((call("spGetDiagnosticOutput", text, request) or b"").decode())
    if failed:
        sys.exit(f"{source} does not compile")
    size = ctypes.c_size_t()
    code = call("spGetEntryPointCode", pointer, request, entry, (ctypes.POINTER(ctypes.c_size_t), ctypes.byref(size)))
    return ctypes.string_at(code, size.value)


def interface(code: bytes) -> dict:
    """What a module declares: for each binding of the library's set its storage class and the layout of its block, and the value of
    the version."""
    words = struct.unpack(f"<{len(code) // 4}I", code)
    decorations, members, types, variables, constants, at = {}, {}, {}, {}, {}, 5
    while at < len(words):
        length, operation = words[at] >> 16, words[at] & 0xFFFF
        operands = words[at + 1 : at + length]
        if operation == 71:  # OpDecorate
            decorations.setdefault(operands[0], {})[operands[1]] = operands[2:]
        elif operation == 72 and operands[2] == OFFSET:  # OpMemberDecorate
            members.setdefault(operands[0], {})[operands[1]] = operands[3]
        elif operation in (28, 29, 30, 32, 23, 21, 22):  # types: array, runtime array, struct, pointer, vector, integer, float
            types[operands[0]] = (operation, operands[1:])
        elif operation == 59:  # OpVariable
            variables[operands[1]] = (operands[0], operands[2])
        elif operation == 50:  # OpSpecConstant
            constants[operands[1]] = operands[2]
        at += length

    def layout(kind):
        operation, operands = types.get(kind, (0, ()))
        if operation == 30:
            return [(members.get(kind, {}).get(index), layout(each)) for index, each in enumerate(operands)]
        if operation == 29:
            return ("array", decorations[kind][ARRAY_STRIDE][0])
        return {21: 1, 22: 1, 23: operands[1] if operation == 23 else 0}.get(operation)

    declared = {}
    for variable, (pointer, storage) in variables.items():
        own = decorations.get(variable, {})
        if own.get(DESCRIPTOR_SET) == (SET,):
            declared[own[BINDING][0]] = (storage, layout(types[pointer][1][1]))
    versions = [value for constant, value in constants.items() if decorations.get(constant, {}).get(SPEC_ID) == (VERSION,)]
    return {"version": versions, **declared}


def main() -> None:
    source, includes, out, reference = sys.argv[1:]
    code = compiled(source, includes)
    pathlib.Path(out).write_bytes(code)
    found, expected = interface(code), interface(pathlib.Path(reference).read_bytes())
    for name in sorted({**found, **expected}, key=str):
        if found.get(name) != expected.get(name):
            sys.exit(f"{source}: {name} is {found.get(name)} and not {expected.get(name)}, as in {reference}")
    print(f"{source}: {len(code)} bytes, {len(found) - 1} bindings, version {found['version'][0]}")


main()
