//! Reflection of compiled shaders, and the Rust file with their interfaces.
//!
//! A shader is compiled twice. The optimised module, which the crate runs, has no names and only the interface that is
//! used; the other module has the names.

use rspirv::binary::{Consumer, ParseAction};
use rspirv::dr::{Instruction, ModuleHeader, Operand};
use rspirv::spirv::{Decoration, Dim, ExecutionMode, Op, StorageClass, Word};
use std::collections::{BTreeMap, HashMap};
use std::fmt::Write as _;

/// A shader compiled with certain macro definitions.
pub struct Compiled {
    /// Name of the compiled file.
    pub name: String,
    /// Name of the source file.
    pub source: String,
    /// Whether its set 0 is the frame's.
    pub in_frame: bool,
    /// Whether it represents an include through which shaders of hosts bind a set.
    pub lent: bool,
    /// The optimised module, which runs.
    pub optimised: Vec<u8>,
    /// The module with names.
    pub named: Vec<u8>,
}

/// Type of a member: a number, several numbers, or a structure.
#[derive(Clone, Debug, PartialEq)]
enum Type {
    Uint,
    Int,
    Float,
    /// Array: type, number and distance in bytes of the elements.
    Several(Box<Type>, u32, u32),
    Struct(Block),
}

/// Structure with its members by offset.
#[derive(Clone, Debug, PartialEq)]
struct Block {
    name: String,
    members: Vec<(String, Type, u32)>,
}

#[derive(Clone, Debug, PartialEq)]
struct Binding {
    name: String,
    kind: &'static str,
    count: u32,
    reads: bool,
    writes: bool,
    /// Members of a uniform block, or of an element of a storage buffer that is a structure.
    block: Option<Block>,
}

#[derive(Clone, Debug, PartialEq)]
struct Constant {
    name: String,
    kind: &'static str,
    default: String,
}

#[derive(Clone, Debug, Default, PartialEq)]
struct Interface {
    bindings: BTreeMap<(u32, u32), Binding>,
    constants: BTreeMap<u32, Constant>,
    push: Option<Block>,
    /// Number of invocations of a workgroup; `None` if a constant determines it, or for other than compute shaders.
    local_size: Option<u32>,
}

/// Instructions of a module. rspirv's own modules don't support workgroups whose size is a constant.
#[derive(Default)]
struct Instructions(Vec<Instruction>);

impl Consumer for Instructions {
    fn initialize(&mut self) -> ParseAction {
        ParseAction::Continue
    }

    fn finalize(&mut self) -> ParseAction {
        ParseAction::Continue
    }

    fn consume_header(&mut self, _: ModuleHeader) -> ParseAction {
        ParseAction::Continue
    }

    fn consume_instruction(&mut self, instruction: Instruction) -> ParseAction {
        self.0.push(instruction);
        ParseAction::Continue
    }
}

/// A module, and the facts about each ID.
struct Known {
    all: Vec<Instruction>,
    names: HashMap<Word, String>,
    members: HashMap<(Word, u32), String>,
    decorations: HashMap<(Word, Decoration), Vec<u32>>,
    offsets: HashMap<(Word, u32), u32>,
    made: HashMap<Word, Instruction>,
}

fn number(operand: &Operand) -> Option<u32> {
    match operand {
        Operand::LiteralBit32(n) => Some(*n),
        _ => None,
    }
}

fn id(operand: &Operand) -> Option<Word> {
    match operand {
        Operand::IdRef(id) => Some(*id),
        _ => None,
    }
}

fn ids(instruction: &Instruction) -> Vec<Word> {
    instruction.operands.iter().filter_map(id).collect()
}

impl Known {
    fn of(bytes: &[u8]) -> Self {
        let mut all = Instructions::default();
        rspirv::binary::parse_bytes(bytes, &mut all).expect("SPIR-V of the compiler's");
        let mut known = Self {
            names: HashMap::new(),
            members: HashMap::new(),
            decorations: HashMap::new(),
            offsets: HashMap::new(),
            made: HashMap::new(),
            all: all.0,
        };
        for i in &known.all {
            match i.operands.as_slice() {
                [Operand::IdRef(of), Operand::LiteralString(name)] if i.class.opcode == Op::Name => {
                    known.names.insert(*of, name.clone());
                }
                [Operand::IdRef(of), Operand::LiteralBit32(member), Operand::LiteralString(name)] => {
                    known.members.insert((*of, *member), name.clone());
                }
                [Operand::IdRef(of), Operand::Decoration(what), rest @ ..] => {
                    let values = rest.iter().filter_map(number).collect();
                    known.decorations.insert((*of, *what), values);
                }
                [
                    Operand::IdRef(of),
                    Operand::LiteralBit32(member),
                    Operand::Decoration(Decoration::Offset),
                    Operand::LiteralBit32(offset),
                ] => {
                    known.offsets.insert((*of, *member), *offset);
                }
                _ => {}
            }
        }
        let all = known.all.iter();
        known.made = all.filter_map(|i| Some((i.result_id?, i.clone()))).collect();
        known
    }

    fn decoration(&self, of: Word, what: Decoration) -> Option<u32> {
        self.decorations.get(&(of, what))?.first().copied()
    }

    /// Value of a constant that is not specialised.
    fn constant(&self, id: Word) -> u32 {
        let made = &self.made[&id];
        assert_eq!(made.class.opcode, Op::Constant, "the length of an array");
        number(&made.operands[0]).expect("32 bits")
    }

    fn type_of(&self, id: Word, matrix_stride: u32) -> Type {
        let made = &self.made[&id];
        let several = |of: Word, count, stride: u32| Type::Several(Box::new(self.type_of(of, stride)), count, stride);
        match made.class.opcode {
            Op::TypeFloat => Type::Float,
            Op::TypeInt if number(&made.operands[1]) == Some(1) => Type::Int,
            Op::TypeInt => Type::Uint,
            Op::TypeVector => several(ids(made)[0], number(&made.operands[1]).expect("a count"), 4),
            Op::TypeMatrix => several(ids(made)[0], number(&made.operands[1]).expect("a count"), matrix_stride),
            Op::TypeArray => {
                let stride = self.decoration(id, Decoration::ArrayStride).expect("a stride");
                several(ids(made)[0], self.constant(ids(made)[1]), stride)
            }
            Op::TypeStruct => Type::Struct(self.block(id)),
            other => panic!("a block of {other:?}"),
        }
    }

    fn block(&self, id: Word) -> Block {
        let members = (0..).zip(ids(&self.made[&id]));
        let members = members.map(|(member, of)| {
            let name = self.members[&(id, member)].clone();
            // Columns of matrices are stored as four floats.
            (name, self.type_of(of, 16), self.offsets[&(id, member)])
        });
        Block { name: self.names[&id].clone(), members: members.collect() }
    }

    /// Variables of a storage class, and the types to which they point.
    fn variables(&self) -> impl Iterator<Item = (Word, StorageClass, Word)> + '_ {
        let variables = self.all.iter().filter(|i| i.class.opcode == Op::Variable);
        variables.map(|i| {
            let pointer = &self.made[&i.result_type.expect("a type")];
            let Operand::StorageClass(class) = i.operands[0] else { panic!("a variable of no class") };
            (i.result_id.expect("an ID"), class, ids(pointer)[0])
        })
    }

    /// Descriptor type of a binding, number of descriptors, and the type of its block if it has one.
    fn kind(&self, class: StorageClass, of: Word) -> (&'static str, u32, Option<Word>) {
        let made = &self.made[&of];
        match (class, made.class.opcode) {
            (StorageClass::Uniform, _) => ("UNIFORM_BUFFER", 1, Some(of)),
            (StorageClass::StorageBuffer, _) => ("STORAGE_BUFFER", 1, Some(of)),
            (_, Op::TypeArray) => {
                let (kind, _, _) = self.kind(class, ids(made)[0]);
                (kind, self.constant(ids(made)[1]), None)
            }
            (_, Op::TypeSampledImage) => ("COMBINED_IMAGE_SAMPLER", 1, None),
            (_, Op::TypeImage) => {
                let is_buffer = made.operands[1] == Operand::Dim(Dim::DimBuffer);
                let is_storage = number(&made.operands[5]) == Some(2);
                let kind = match (is_buffer, is_storage) {
                    (true, false) => "UNIFORM_TEXEL_BUFFER",
                    (true, true) => "STORAGE_TEXEL_BUFFER",
                    (false, false) => "SAMPLED_IMAGE",
                    (false, true) => "STORAGE_IMAGE",
                };
                (kind, 1, None)
            }
            (_, other) => panic!("a binding of {other:?}"),
        }
    }

    /// Whether the module reads and writes through a pointer, or through an image that was loaded from it.
    fn uses(&self, pointer: Word, is_image: bool) -> (bool, bool) {
        let (mut reads, mut writes) = (false, false);
        let mut add = |(r, w): (bool, bool)| {
            reads |= r;
            writes |= w;
        };
        for i in &self.all {
            let operands = ids(i);
            if !operands.contains(&pointer) {
                continue;
            }
            let result = || i.result_id.expect("a result");
            match i.class.opcode {
                Op::AccessChain | Op::InBoundsAccessChain | Op::CopyObject => {
                    add(self.uses(result(), is_image));
                }
                Op::SampledImage | Op::Image => add(self.uses(result(), true)),
                Op::Load if is_image => add(self.uses(result(), true)),
                Op::Load => add((true, false)),
                Op::Store | Op::ImageWrite => add((false, true)),
                Op::ArrayLength
                | Op::ImageQuerySize
                | Op::ImageQuerySizeLod
                | Op::ImageQueryLevels
                | Op::EntryPoint
                | Op::Decorate
                | Op::Name => {}
                other if format!("{other:?}").starts_with("Atomic") => add((true, true)),
                other if format!("{other:?}").starts_with("Image") => add((true, false)),
                other => panic!("what is bound is used by {other:?}"),
            }
        }
        (reads, writes)
    }
}

/// Name of a binding: the name of the variable, or of the only member of its block, or of the block.
fn bound_name(known: &Known, variable: Word, block: Option<Word>) -> String {
    let name = known.names.get(&variable).cloned().unwrap_or_default();
    let Some(block) = block.filter(|_| name.is_empty()) else {
        return name;
    };
    match ids(&known.made[&block]).len() {
        1 => known.members[&(block, 0)].clone(),
        _ => snake(&known.names[&block]),
    }
}

/// Structure of a storage buffer's array elements, or members of a uniform block.
fn shared_block(known: &Known, kind: &str, block: Option<Word>) -> Option<Block> {
    let block = block?;
    if kind == "UNIFORM_BUFFER" {
        return Some(known.block(block));
    }
    let [member] = ids(&known.made[&block])[..] else {
        return None;
    };
    let of = &known.made[&member];
    let element = ids(of).first().copied().filter(|_| of.class.opcode == Op::TypeRuntimeArray)?;
    let is_struct = known.made[&element].class.opcode == Op::TypeStruct;
    is_struct.then(|| known.block(element))
}

fn reflect(compiled: &Compiled) -> Interface {
    let named = Known::of(&compiled.named);
    let run = Known::of(&compiled.optimised);
    let place = |known: &Known, id| {
        let set = known.decoration(id, Decoration::DescriptorSet)?;
        Some((set, known.decoration(id, Decoration::Binding)?))
    };
    let mut interface = Interface::default();
    for (variable, class, of) in run.variables() {
        let Some(at) = place(&run, variable) else {
            continue;
        };
        let (kind, count, block) = run.kind(class, of);
        let (reads, writes) = run.uses(variable, block.is_none());
        let (same, named_class, named_of) =
            named.variables().find(|(other, _, _)| place(&named, *other) == Some(at)).expect("both modules have it");
        let (_, _, named_block) = named.kind(named_class, named_of);
        let binding = Binding {
            name: bound_name(&named, same, named_block),
            kind,
            count,
            reads,
            writes,
            block: shared_block(&named, kind, named_block),
        };
        let before = interface.bindings.insert(at, binding);
        assert!(before.is_none(), "{}: two of {at:?}", compiled.name);
    }
    for ((of, what), values) in &run.decorations {
        if *what != Decoration::SpecId {
            continue;
        }
        let id = values[0];
        let made = &run.made[of];
        let name = named.decorations.iter().find_map(|((other, what), values)| {
            (*what == Decoration::SpecId && values[0] == id).then(|| named.names.get(other))?
        });
        let value = made.operands.first().and_then(number);
        let (kind, default) = match made.class.opcode {
            Op::SpecConstantTrue => ("bool", "true".to_owned()),
            Op::SpecConstantFalse => ("bool", "false".to_owned()),
            _ => ("u32", value.expect("32 bits").to_string()),
        };
        let constant = Constant {
            // Only the constant of the workgroup's size has no name.
            name: name.map_or_else(|| "local_size".to_owned(), |name| name.to_lowercase()),
            kind,
            default,
        };
        interface.constants.insert(id, constant);
    }
    interface.push =
        named.variables().find(|(_, class, _)| *class == StorageClass::PushConstant).map(|(_, _, of)| named.block(of));
    interface.local_size = run.all.iter().find_map(|mode| {
        let is_size = mode.class.opcode == Op::ExecutionMode
            && mode.operands[1] == Operand::ExecutionMode(ExecutionMode::LocalSize);
        is_size.then(|| number(&mode.operands[2]))?
    });
    interface
}

/// Adds the interface of another variant of a shader.
fn unite(all: &mut Interface, other: Interface) {
    for (at, binding) in other.bindings {
        match all.bindings.get_mut(&at) {
            Some(known) => {
                known.reads |= binding.reads;
                known.writes |= binding.writes;
                assert_eq!((&known.name, known.kind), (&binding.name, binding.kind));
            }
            None => {
                all.bindings.insert(at, binding);
            }
        }
    }
    for (id, constant) in other.constants {
        match all.constants.get(&id) {
            Some(known) => assert_eq!(*known, constant),
            None => {
                all.constants.insert(id, constant);
            }
        }
    }
    all.push = all.push.take().or(other.push);
    all.local_size = all.local_size.or(other.local_size);
}

fn snake(name: &str) -> String {
    let mut snake = String::new();
    for (i, c) in name.chars().enumerate() {
        if c.is_uppercase() && i > 0 {
            snake.push('_');
        }
        snake.extend(c.to_lowercase());
    }
    snake
}

fn camel(name: &str) -> String {
    let words = name.split('_').filter(|word| !word.is_empty());
    words
        .map(|word| {
            let (first, rest) = word.split_at(1);
            first.to_uppercase() + &rest.to_lowercase()
        })
        .collect()
}

/// Name of a member in Rust; an underscore that GLSL needs after reserved words is removed.
fn field(name: &str) -> String {
    match name.trim_end_matches('_') {
        // `box` is reserved in Rust.
        "box" => "r#box".to_owned(),
        name => name.to_owned(),
    }
}

impl Type {
    fn rust(&self) -> String {
        match self {
            Self::Uint => "u32".to_owned(),
            Self::Int => "i32".to_owned(),
            Self::Float => "f32".to_owned(),
            // In Rust, matrices are flat arrays.
            Self::Several(of, count, stride) => match &**of {
                Self::Several(inner, rows, _) if **inner == Self::Float && (*count, *rows, *stride) == (4, 4, 16) => {
                    "[f32; 16]".to_owned()
                }
                of => format!("[{}; {count}]", of.rust()),
            },
            Self::Struct(block) => block.name.clone(),
        }
    }

    /// Number of bytes in Rust, where elements have no gaps.
    fn bytes(&self) -> u32 {
        match self {
            Self::Uint | Self::Int | Self::Float => 4,
            Self::Several(of, count, stride) => {
                assert_eq!(of.bytes(), *stride, "elements lie apart");
                count * stride
            }
            Self::Struct(block) => block.bytes(),
        }
    }
}

impl Block {
    fn bytes(&self) -> u32 {
        self.members.last().map_or(0, |(_, of, offset)| offset + of.bytes())
    }

    /// Definition of the structure in Rust under a name, preceded by those of its members' types. Blocks whose size
    /// must be a multiple of 16 bytes end with padding.
    fn rust(&self, name: &str, what: &str, multiple: u32) -> String {
        let mut code = format!(
            "\n/// {what}\n#[repr(C)]\n#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]\npub struct {name} {{\n"
        );
        let mut end = 0;
        let pad = |code: &mut String, end: u32, to: u32| {
            if to > end {
                writeln!(code, "    pub padding_{end}: [u32; {}],", (to - end) / 4).expect("a string");
            }
        };
        for (name, of, offset) in &self.members {
            pad(&mut code, end, *offset);
            writeln!(code, "    pub {}: {},", field(name), of.rust()).expect("a string");
            end = offset + of.bytes();
        }
        pad(&mut code, end, end.next_multiple_of(multiple));
        code + "}\n"
    }
}

/// Interface of a shader over all of its variants.
struct Shader<'a> {
    source: &'a str,
    in_frame: bool,
    lent: bool,
    variants: Vec<&'a str>,
    interface: Interface,
}

fn shaders(all: &[Compiled]) -> BTreeMap<String, Shader<'_>> {
    let mut shaders: BTreeMap<String, Shader<'_>> = BTreeMap::new();
    for compiled in all {
        let interface = reflect(compiled);
        let file = compiled.source.rsplit('/').next().expect("a file");
        let (stem, stage) = file.split_once('.').expect("a shader's file has a stage");
        let name = match stage {
            "vert" => format!("{stem}_vertex"),
            "frag" => format!("{stem}_fragment"),
            _ => stem.to_owned(),
        };
        match shaders.get_mut(&name) {
            Some(shader) => {
                shader.variants.push(&compiled.name);
                unite(&mut shader.interface, interface);
            }
            None => {
                let shader = Shader {
                    source: &compiled.source,
                    in_frame: compiled.in_frame,
                    lent: compiled.lent,
                    variants: vec![&compiled.name],
                    interface,
                };
                shaders.insert(name, shader);
            }
        }
    }
    shaders
}

/// Bindings of the sets that all passes of a frame share; their numbers differ.
fn frame_set(shaders: &BTreeMap<String, Shader<'_>>) -> BTreeMap<u32, Binding> {
    let mut set: BTreeMap<u32, Binding> = BTreeMap::new();
    let in_frame = shaders.values().filter(|shader| shader.in_frame);
    for ((of, number), binding) in in_frame.flat_map(|shader| &shader.interface.bindings) {
        if *of > 1 {
            continue;
        }
        match set.get_mut(number) {
            // A fragment shader declares a binding a second time as read-only.
            Some(known) if known.name == format!("{}_in", binding.name) => {
                known.name.clone_from(&binding.name);
            }
            Some(known) => assert!(
                known.name == binding.name || format!("{}_in", known.name) == binding.name,
                "{number}: {} and {}",
                known.name,
                binding.name
            ),
            None => {
                set.insert(*number, binding.clone());
            }
        }
    }
    set
}

/// Names and values of `#define PREFIX_NAME value`, in order.
fn defines<'a>(text: &'a str, prefix: &str) -> Vec<(&'a str, u32)> {
    text.lines()
        .filter_map(|line| {
            let mut words = line.strip_prefix("#define ")?.split_whitespace();
            let name = words.next()?.strip_prefix(prefix)?;
            let value = words.next()?.trim_end_matches('u');
            let value = match value.strip_prefix("0x") {
                Some(digits) => u32::from_str_radix(digits, 16),
                None => value.parse(),
            };
            Some((name, value.ok()?))
        })
        .collect()
}

const HEAD: &str = "\
//! What the host and the shaders both know: bindings, specialisation constants, push constants and shared blocks of each
//! shader, by name. `make shaders` writes this file from the compiled shaders and from `shaders/include/interface.glsl`.

use crate::vulkan::{
    Access, Binding, Compiled, Constants, Interface, Invocations, Specialized, Use,
};
use ash::vk::DescriptorType as Kind;

include!(concat!(env!(\"OUT_DIR\"), \"/spirv.rs\"));
";

fn binding(number: u32, binding: &Binding) -> String {
    format!("Binding::new({number}, {:?}, Kind::{}, {})", binding.name, binding.kind, binding.count)
}

/// Module with the bindings of a set, and with a list of them where it is `lent` to hosts.
fn set_module(name: &str, what: &str, bound: &[(u32, &Binding)], lent: bool) -> String {
    let mut code = format!("\n/// {what}\npub mod {name} {{\n    use super::{{Binding, Kind}};\n\n");
    let mut all = String::new();
    for (number, bound) in bound {
        let name = bound.name.to_uppercase();
        writeln!(code, "    pub const {name}: Binding = {};", binding(*number, bound)).expect("a string");
        writeln!(all, "        {name},").expect("a string");
    }
    if lent {
        writeln!(code, "    pub const ALL: [Binding; {}] = [\n{all}    ];", bound.len()).expect("a string");
    }
    code + "}\n"
}

/// Text of the Rust file.
pub fn rust(all: &[Compiled], numbers: &str) -> String {
    let shaders = shaders(all);
    let mut code = HEAD.to_owned();
    let frame = frame_set(&shaders);
    let bound: Vec<_> = frame.iter().map(|(number, bound)| (*number, bound)).collect();
    code += &set_module("frame_set", "The sets that the passes of a frame share.", &bound, false);
    let mut blocks: Vec<(String, Block)> = Vec::new();
    let mut pushed: Vec<(String, Block)> = Vec::new();
    for (name, shader) in &shaders {
        code += &of_shader(name, shader, &frame, &mut blocks, &mut pushed);
    }
    let own = shaders.iter().filter(|(_, shader)| !shader.lent);
    let all: Vec<_> = own.map(|(name, _)| camel(name)).collect();
    writeln!(code, "\n/// Interfaces of all shaders.\npub const INTERFACES: [&Interface; {}] = [", all.len())
        .expect("a string");
    for name in all {
        writeln!(code, "    {name}::INTERFACE,").expect("a string");
    }
    code + "];\n" + &of_numbers(numbers)
}

fn of_shader(
    name: &str,
    shader: &Shader<'_>,
    frame: &BTreeMap<u32, Binding>,
    blocks: &mut Vec<(String, Block)>,
    pushed: &mut Vec<(String, Block)>,
) -> String {
    let Shader { source, in_frame, lent, variants, interface } = shader;
    let mut code = String::new();
    let title = camel(name);
    for bound in interface.bindings.values() {
        let Some(block) = &bound.block else {
            continue;
        };
        let known = blocks.iter().find(|(name, _)| *name == block.name);
        if let Some((_, known)) = known {
            assert_eq!(known, block, "{name}");
            continue;
        }
        let (what, multiple) = match bound.kind {
            "UNIFORM_BUFFER" => ("The uniform block", 16),
            _ => ("An element of the buffer", 4),
        };
        code += &block.rust(&block.name, &format!("{what} `{}`, as in `shaders/{source}`.", bound.name), multiple);
        blocks.push((block.name.clone(), block.clone()));
    }
    let push_type = match interface.push {
        Some(_) => format!("{title}Push"),
        None => "()".to_owned(),
    };
    let push = interface.push.as_ref().map(|push| {
        let name = push_type.clone();
        match pushed.iter().find(|(_, known)| known.members == push.members) {
            Some((known, _)) => {
                writeln!(code, "\n/// What is pushed to `shaders/{source}`.\npub type {name} = {known};")
                    .expect("a string");
            }
            None => {
                code += &push.rust(&name, &format!("What is pushed to `shaders/{source}`."), 4);
                pushed.push((name.clone(), push.clone()));
            }
        }
        push.bytes()
    });
    let mut by_set: BTreeMap<u32, Vec<(u32, &Binding)>> = BTreeMap::new();
    for ((set, number), bound) in &interface.bindings {
        by_set.entry(*set).or_default().push((*number, bound));
    }
    let is_frames = |set: u32| set < 2 && *in_frame;
    for (_, bound) in by_set.iter().filter(|(set, _)| !is_frames(**set)) {
        let beside = if *in_frame { "beside the frame's" } else { "of its own" };
        let what = if *lent {
            format!("The set of `shaders/{source}`, which hosts' shaders bind.")
        } else {
            format!("The set {beside} that `shaders/{source}` binds.")
        };
        code += &set_module(&format!("{name}_set"), &what, bound, *lent);
    }
    if *lent {
        for (id, constant) in &interface.constants {
            writeln!(
                code,
                "\n/// A constant of `shaders/{source}`: its ID and its value.\npub const {}: (u32, {}) = ({id}, {});",
                constant.name.to_uppercase(),
                constant.kind,
                constant.default
            )
            .expect("a string");
        }
        return code;
    }
    let constants = interface.constants.values();
    if interface.constants.is_empty() {
        writeln!(code, "\n/// `shaders/{source}`, which has no constants.\n#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]\npub struct {title};").expect("a string");
    } else {
        writeln!(code, "\n/// Constants of `shaders/{source}`.\n#[derive(Clone, Copy, Debug, PartialEq, Eq)]\npub struct {title} {{").expect("a string");
        for constant in constants.clone() {
            writeln!(code, "    pub {}: {},", constant.name, constant.kind).expect("a string");
        }
        writeln!(code, "}}\n\nimpl Default for {title} {{\n    fn default() -> Self {{\n        Self {{")
            .expect("a string");
        for constant in constants {
            writeln!(code, "            {}: {},", constant.name, constant.default).expect("a string");
        }
        code += "        }\n    }\n}\n";
    }
    writeln!(code, "\nimpl Specialized for {title} {{\n    type Push = {push_type};\n\n    const INTERFACE: &'static Interface = &Interface {{\n        name: {name:?},\n        in_frame: {in_frame},\n        uses: &[").expect("a string");
    for (set, bound) in &by_set {
        for (number, bound) in bound {
            let what = if is_frames(*set) {
                format!("frame_set::{}", frame[number].name.to_uppercase())
            } else {
                format!("{name}_set::{}", bound.name.to_uppercase())
            };
            let access = match (bound.reads, bound.writes) {
                (true, true) => "ReadWrite",
                (false, true) => "Write",
                _ => "Read",
            };
            writeln!(code, "            Use {{ set: {set}, binding: {what}, access: Access::{access} }},")
                .expect("a string");
        }
    }
    let invocations = match (interface.local_size, interface.constants.get(&0)) {
        (Some(size), _) => format!("Invocations::Fixed({size})"),
        (None, Some(constant)) if constant.name == "local_size" => "Invocations::Constant".to_owned(),
        _ => "Invocations::Drawn".to_owned(),
    };
    writeln!(
        code,
        "        ],\n        push_bytes: {},\n        invocations: {invocations},\n        by_teams: {},\n    }};",
        push.unwrap_or(0),
        interface.local_size.is_none() && interface.constants.values().any(|constant| constant.name == "team")
    )
    .expect("a string");
    let values: String = interface
        .constants
        .iter()
        .map(|(id, constant)| {
            let how = if constant.kind == "bool" { "flag" } else { "with" };
            format!("\n            .{how}({id}, self.{})", constant.name)
        })
        .collect();
    writeln!(code, "\n    fn constants(&self) -> Constants {{\n        Constants::new(){values}\n    }}\n}}")
        .expect("a string");
    if let [variant] = variants[..] {
        writeln!(
            code,
            "\nimpl Compiled for {title} {{\n    fn code() -> &'static [u8] {{\n        {}\n    }}\n}}",
            variant.to_uppercase()
        )
        .expect("a string");
    }
    code
}

fn of_numbers(numbers: &str) -> String {
    let mut code = String::new();
    let counters = defines(numbers, "COUNTER_");
    code += "\n/// What passes count, a word each, as `shaders/include/interface.glsl` describes it.\n#[repr(C)]\n#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]\npub struct Counters {\n";
    for (number, (name, value)) in counters.iter().enumerate() {
        assert_eq!(*value as usize, number, "counters have gaps");
        writeln!(code, "    pub {}: u32,", name.to_lowercase()).expect("a string");
    }
    code += "}\n";
    code += "\n/// Their places among the words.\n#[derive(Clone, Copy, Debug, PartialEq, Eq)]\n#[repr(usize)]\npub enum Counter {\n";
    for (name, _) in &counters {
        writeln!(code, "    {},", camel(name)).expect("a string");
    }
    code += "}\n";
    code += "\n/// Indices of indirect dispatches.\n#[derive(Clone, Copy, Debug, PartialEq, Eq)]\n#[repr(u32)]\npub enum Argument {\n";
    for (name, value) in defines(numbers, "ARGUMENT_") {
        writeln!(code, "    {} = {value},", camel(name)).expect("a string");
    }
    code += "}\n\nimpl Argument {\n    /// Their names, in their order.\n    pub const NAMES: &[&str] = &[\n";
    for (number, (name, value)) in defines(numbers, "ARGUMENT_").iter().enumerate() {
        assert_eq!(*value as usize, number, "arguments have gaps");
        writeln!(code, "        {:?},", name.to_lowercase().replace('_', " ")).expect("a string");
    }
    code += "    ];\n}\n\n";
    let known = ["COUNTER_", "ARGUMENT_", "BINDING_", "CONSTANT_", "SET_"];
    for (name, value) in defines(numbers, "") {
        let is_known = known.iter().any(|part| name.starts_with(part) || name.contains(&format!("_{part}")));
        if !is_known {
            writeln!(code, "pub const {name}: u32 = {value};").expect("a string");
        }
    }
    code
}
