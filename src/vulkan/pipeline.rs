//! Compute pipelines, whose layout comes from the shader itself, and what is bound to them.

use super::{
    Buffer, Device, Image, NEEDED, ResourceKind, ShaderInterface, TexelBuffer, UniformBuffer, check,
};
use crate::error::Result;
use ash::vk;
use std::sync::Arc;

/// A compiled compute shader.
#[derive(Debug, Clone, Copy)]
pub struct Shader {
    /// The name of its pass, its file and its debug label.
    pub name: &'static str,
    /// Its SPIR-V, little-endian.
    pub spirv: &'static [u8],
}

/// The shader of `shaders/NAME.comp`, compiled in.
macro_rules! shader {
    ($name:literal) => {
        $crate::vulkan::Shader {
            name: $name,
            spirv: include_bytes!(concat!(env!("OUT_DIR"), "/", $name, ".comp.spv")),
        }
    };
}
pub(crate) use shader;

/// A compute pipeline with its layout.
pub struct ComputePipeline {
    pub(super) raw: vk::Pipeline,
    pub(super) layout: vk::PipelineLayout,
    set_layout: vk::DescriptorSetLayout,
    interface: ShaderInterface,
    name: &'static str,
    device: Arc<Device>,
}

/// A resource to bind.
#[derive(Clone)]
pub enum Binding {
    /// A storage buffer.
    Buffer(Arc<Buffer>),
    /// A uniform buffer.
    Uniform(Arc<UniformBuffer>),
    /// A storage image.
    Image(Arc<Image>),
    /// A buffer read as texels.
    Texels(Arc<TexelBuffer>),
}

/// Resources bound to the places of one pipeline, which it keeps alive.
pub struct BindingSet {
    pub(super) raw: vk::DescriptorSet,
    pool: vk::DescriptorPool,
    device: Arc<Device>,
    _resources: Vec<(u32, Binding)>,
}

impl Shader {
    /// Its SPIR-V words.
    pub fn words(&self) -> Vec<u32> {
        let words = self.spirv.chunks_exact(4);
        words.map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect()
    }

    /// Its bindings, constants and struct layouts, read from the SPIR-V.
    pub fn interface(&self) -> ShaderInterface {
        ShaderInterface::of(&self.words())
    }
}

impl ComputePipeline {
    /// A pipeline of the shader, with the values of its specialization constants by their ids. Constants that the shader
    /// does not have are left out, so that all shaders of a scene can be given the same ones.
    ///
    /// # Panics
    /// Where one of the shader's constants has no value: that is a bug.
    pub fn new(device: &Arc<Device>, shader: Shader, constants: &[(u32, u32)]) -> Result<Self> {
        let interface = shader.interface();
        for id in &interface.constants {
            let given = constants.iter().filter(|(given, _)| given == id).count();
            assert_eq!(given, 1, "{}: values of the constant {id}", shader.name);
        }
        log::debug!("compiling {}", shader.name);
        let mut pipeline = Self {
            raw: vk::Pipeline::null(),
            layout: vk::PipelineLayout::null(),
            set_layout: vk::DescriptorSetLayout::null(),
            name: shader.name,
            device: Arc::clone(device),
            interface,
        };
        pipeline.create(&shader.words(), constants)?;
        device.set_name(pipeline.raw, shader.name);
        Ok(pipeline)
    }

    fn create(&mut self, words: &[u32], constants: &[(u32, u32)]) -> Result<()> {
        let bindings: Vec<_> = (self.interface.resources.iter())
            .map(|(binding, kind)| {
                vk::DescriptorSetLayoutBinding::default()
                    .binding(*binding)
                    .descriptor_type(kind.descriptor_type())
                    .descriptor_count(1)
                    .stage_flags(vk::ShaderStageFlags::COMPUTE)
            })
            .collect();
        let set = vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings);
        // SAFETY: the device is valid, and `self` owns the handle.
        let layout = unsafe { self.device.raw.create_descriptor_set_layout(&set, None) };
        self.set_layout = check("creating a descriptor set layout", layout)?;

        let push = vk::PushConstantRange::default()
            .stage_flags(vk::ShaderStageFlags::COMPUTE)
            .size(self.interface.push_size);
        let (sets, pushes) = ([self.set_layout], [push]);
        let mut layout = vk::PipelineLayoutCreateInfo::default().set_layouts(&sets);
        if self.interface.push_size > 0 {
            layout = layout.push_constant_ranges(&pushes);
        }
        // SAFETY: the set layout is of this device, and `self` owns the handle.
        let layout = unsafe { self.device.raw.create_pipeline_layout(&layout, None) };
        self.layout = check("creating a pipeline layout", layout)?;

        let own = constants.iter().filter(|(id, _)| self.interface.constants.contains(id));
        let (ids, values): (Vec<u32>, Vec<u32>) = own.copied().unzip();
        let entries: Vec<_> = (0..)
            .zip(ids)
            .map(|(at, id)| vk::SpecializationMapEntry { constant_id: id, offset: 4 * at, size: 4 })
            .collect();
        let specialization =
            vk::SpecializationInfo::default().map_entries(&entries).data(bytemuck::cast_slice(&values));
        let module = vk::ShaderModuleCreateInfo::default().code(words);
        // SAFETY: the words are SPIR-V that build.rs compiled. The module is destroyed whether or
        // not the pipeline could be made of it, and not needed after.
        let created = unsafe {
            let module =
                check("creating a shader module", self.device.raw.create_shader_module(&module, None))?;
            let stage = vk::PipelineShaderStageCreateInfo::default()
                .stage(vk::ShaderStageFlags::COMPUTE)
                .module(module)
                .name(c"main")
                .specialization_info(&specialization);
            let info = [vk::ComputePipelineCreateInfo::default().stage(stage).layout(self.layout)];
            let created = self.device.raw.create_compute_pipelines(self.device.pipeline_cache(), &info, None);
            self.device.raw.destroy_shader_module(module, None);
            created
        };
        self.raw = check("creating a compute pipeline", created.map_err(|(_, result)| result))?[0];
        Ok(())
    }

    /// The shader's name.
    pub fn name(&self) -> &'static str {
        self.name
    }

    pub(super) fn workgroups(&self, extent: [u32; 2]) -> [u32; 2] {
        [0, 1].map(|axis| extent[axis].div_ceil(self.interface.local_size[axis]))
    }

    pub(super) fn assert_push_size(&self, push: &[u8]) {
        let wanted = self.interface.push_size as usize;
        assert_eq!(push.len(), wanted, "{}: push constants of the wrong size", self.name);
    }
}

impl Drop for ComputePipeline {
    fn drop(&mut self) {
        // SAFETY: whoever records commands with the pipeline holds it until they are done; null
        // handles are allowed.
        unsafe {
            self.device.raw.destroy_pipeline(self.raw, None);
            self.device.raw.destroy_pipeline_layout(self.layout, None);
            self.device.raw.destroy_descriptor_set_layout(self.set_layout, None);
        }
    }
}

impl BindingSet {
    /// Binds `resources`, each at its binding number. There must be one for each of the shader's.
    pub fn new(pipeline: &ComputePipeline, resources: &[(u32, Binding)]) -> Result<Self> {
        let device = &pipeline.device;
        for (binding, resource) in resources {
            let wanted = pipeline.interface.resources.get(binding);
            assert_eq!(wanted, Some(&resource.kind()), "{}: binding {binding}", pipeline.name);
        }
        assert_eq!(resources.len(), pipeline.interface.resources.len(), "{}: bindings", pipeline.name);

        let count = |kind| {
            let of_kind = resources.iter().filter(|(_, resource)| resource.kind() == kind).count();
            u32::try_from(of_kind).expect("few bindings")
        };
        let sizes: Vec<_> = NEEDED
            .into_iter()
            .filter(|(kind, _)| count(*kind) > 0)
            .map(|(kind, _)| vk::DescriptorPoolSize {
                ty: kind.descriptor_type(),
                descriptor_count: count(kind),
            })
            .collect();
        let pool = vk::DescriptorPoolCreateInfo::default().max_sets(1).pool_sizes(&sizes);
        // SAFETY: the device is valid; the handle goes into its guard before the next call.
        let pool =
            check("creating a descriptor pool", unsafe { device.raw.create_descriptor_pool(&pool, None) })?;
        let mut set = Self {
            raw: vk::DescriptorSet::null(),
            pool,
            device: Arc::clone(device),
            _resources: resources.to_vec(),
        };
        let layouts = [pipeline.set_layout];
        let allocate = vk::DescriptorSetAllocateInfo::default().descriptor_pool(pool).set_layouts(&layouts);
        // SAFETY: the pool has room for this one set.
        let sets = unsafe { device.raw.allocate_descriptor_sets(&allocate) };
        set.raw = check("allocating a descriptor set", sets)?[0];
        for (binding, resource) in resources {
            set.write(*binding, resource);
        }
        Ok(set)
    }

    fn write(&self, binding: u32, resource: &Binding) {
        let write = vk::WriteDescriptorSet::default()
            .dst_set(self.raw)
            .dst_binding(binding)
            .descriptor_type(resource.kind().descriptor_type());
        let whole =
            |buffer: &Buffer| [vk::DescriptorBufferInfo::default().buffer(buffer.raw).range(vk::WHOLE_SIZE)];
        let (buffer, image, view);
        let write = match resource {
            Binding::Buffer(bound) => {
                buffer = whole(bound);
                write.buffer_info(&buffer)
            }
            Binding::Uniform(bound) => {
                buffer = whole(&bound.buffer);
                write.buffer_info(&buffer)
            }
            Binding::Image(bound) => {
                image = [vk::DescriptorImageInfo::default()
                    .image_view(bound.view)
                    .image_layout(vk::ImageLayout::GENERAL)];
                write.image_info(&image)
            }
            Binding::Texels(bound) => {
                view = [bound.view];
                write.texel_buffer_view(&view)
            }
        };
        // SAFETY: the set is new and not in use; the resource lives as long as it.
        unsafe { self.device.raw.update_descriptor_sets(&[write], &[]) };
    }
}

impl Drop for BindingSet {
    fn drop(&mut self) {
        // SAFETY: whoever records commands with the set holds it until they are done.
        unsafe { self.device.raw.destroy_descriptor_pool(self.pool, None) };
    }
}

impl Binding {
    fn kind(&self) -> ResourceKind {
        match self {
            Self::Buffer(_) => ResourceKind::Buffer,
            Self::Uniform(_) => ResourceKind::Uniform,
            Self::Image(_) => ResourceKind::Image,
            Self::Texels(_) => ResourceKind::Texels,
        }
    }
}
