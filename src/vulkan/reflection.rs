//! What a compiled shader says of itself: its bindings, workgroup and push constants, and the
//! layouts of its structs.

use ash::vk;
use spirq::ReflectConfig;
use spirq::constant::ConstantValue;
use spirq::spirv::ExecutionMode;
use spirq::ty::{DescriptorType, Type};
use spirq::var::Variable;
use std::collections::{BTreeMap, BTreeSet};

/// What a shader binds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResourceKind {
    /// A storage buffer.
    Buffer,
    /// A uniform buffer.
    Uniform,
    /// A storage image.
    Image,
    /// A buffer read as texels of four u32.
    Texels,
}

/// A struct of a shader: where its members lie, in bytes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct StructLayout {
    /// The struct's name in GLSL.
    pub name: String,
    /// Name and offset of each member, in order.
    pub members: Vec<(String, usize)>,
    /// Distance between two of them in an array, where the shader has such an array.
    pub stride: Option<usize>,
}

/// A compute shader's interface.
#[derive(Debug, Clone)]
pub struct ShaderInterface {
    /// The resources of descriptor set 0, by binding.
    pub resources: BTreeMap<u32, ResourceKind>,
    /// Their names in GLSL: of a buffer that of its block.
    pub names: BTreeMap<u32, String>,
    /// The ids of the specialization constants.
    pub constants: BTreeSet<u32>,
    /// Workgroup size in x and y.
    pub local_size: [u32; 2],
    /// Bytes of push constants.
    pub push_size: u32,
    /// Every struct that a buffer or the push constants hold.
    pub structs: Vec<StructLayout>,
}

impl ResourceKind {
    pub(super) fn descriptor_type(self) -> vk::DescriptorType {
        match self {
            Self::Buffer => vk::DescriptorType::STORAGE_BUFFER,
            Self::Uniform => vk::DescriptorType::UNIFORM_BUFFER,
            Self::Image => vk::DescriptorType::STORAGE_IMAGE,
            Self::Texels => vk::DescriptorType::UNIFORM_TEXEL_BUFFER,
        }
    }
}

impl ShaderInterface {
    /// Reads it from SPIR-V.
    ///
    /// # Panics
    /// On SPIR-V that is no compute shader, or that binds what this crate has no use for: the
    /// shaders are compiled in, so that is a bug.
    pub fn of(spirv: &[u32]) -> Self {
        let entry_points = ReflectConfig::new().spv(spirv).ref_all_rscs(true).reflect();
        let entry_points = entry_points.expect("build.rs compiled valid SPIR-V");
        let [entry_point] = entry_points.as_slice() else {
            panic!("a compute shader has one entry point");
        };
        let mut interface = Self {
            resources: BTreeMap::new(),
            names: BTreeMap::new(),
            constants: BTreeSet::new(),
            local_size: [1, 1],
            push_size: 0,
            structs: Vec::new(),
        };
        for mode in &entry_point.exec_modes {
            if mode.exec_mode == ExecutionMode::LocalSize {
                interface.local_size = [0, 1].map(|axis| match mode.operands[axis].value {
                    ConstantValue::U32(size) => size,
                    _ => panic!("a workgroup size is a u32"),
                });
            }
        }
        for variable in &entry_point.vars {
            interface.add(variable);
        }
        interface
    }

    fn add(&mut self, variable: &Variable) {
        match variable {
            Variable::Descriptor { name, desc_bind, desc_ty, ty, .. } => {
                assert_eq!(desc_bind.set(), 0, "there is one descriptor set");
                let kind = match desc_ty {
                    DescriptorType::StorageBuffer(_) => ResourceKind::Buffer,
                    DescriptorType::UniformBuffer() => ResourceKind::Uniform,
                    DescriptorType::StorageImage(_) => ResourceKind::Image,
                    DescriptorType::UniformTexelBuffer() => ResourceKind::Texels,
                    other => panic!("no use for {other:?}"),
                };
                let block = if let Type::Struct(block) = ty { block.name.clone() } else { None };
                self.names.insert(desc_bind.bind(), block.or(name.clone()).unwrap_or_default());
                self.resources.insert(desc_bind.bind(), kind);
                self.collect(ty, None);
            }
            Variable::PushConstant { ty, .. } => {
                let size = ty.nbyte().expect("push constants have a size");
                self.push_size = u32::try_from(size).expect("push constants are small");
                self.collect(ty, None);
            }
            Variable::SpecConstant { spec_id, .. } => {
                self.constants.insert(*spec_id);
            }
            Variable::Input { .. } | Variable::Output { .. } => {}
        }
    }

    fn collect(&mut self, ty: &Type, stride: Option<usize>) {
        match ty {
            Type::Array(array) => self.collect(&array.element_ty, array.stride),
            Type::Struct(found) => {
                for member in &found.members {
                    self.collect(&member.ty, None);
                }
                let layout = StructLayout {
                    name: found.name.clone().unwrap_or_default(),
                    members: (found.members.iter())
                        .filter_map(|member| Some((member.name.clone()?, member.offset?)))
                        .collect(),
                    stride,
                };
                if !self.structs.contains(&layout) {
                    self.structs.push(layout);
                }
            }
            _ => {}
        }
    }
}
