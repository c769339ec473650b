//! The shaders' structs and their Rust twins, byte for byte.

use std::mem::offset_of;
use thinlens::gpu_types::*;
use thinlens::interface::binding;
use thinlens::passes::{Accumulate, Geometry, Pick, Resolve, Select, Trace};
use thinlens::vulkan::{NEEDED, Shader, StructLayout};

const SHADERS: [Shader; 7] = [
    Trace::SHADERS[0],
    Trace::SHADERS[1],
    Accumulate::SHADER,
    Select::SHADER,
    Resolve::SHADER,
    Pick::SHADER,
    Geometry::SHADER,
];

/// A twin: name, fields with offsets, and size.
macro_rules! twin {
    ($glsl:literal, $rust:ident, [$($field:ident),+ $(,)?]) => {
        ($glsl, vec![$((stringify!($field), offset_of!($rust, $field))),+], size_of::<$rust>())
    };
}

type Twin = (&'static str, Vec<(&'static str, usize)>, usize);

fn twins() -> Vec<Twin> {
    vec![
        twin!("Texture", Texture, [color, kind, other_color, inverse_size, phase]),
        twin!("Material", Material, [color, ka, kd, ks, exponent, kind, roughness, index, metallic]),
        twin!("Lamp", Lamp, [shape, radiance, end, velocity]),
        twin!("Light", Light, [radiance, kind, position_or_direction]),
        twin!(
            "Environment",
            Environment,
            [horizon, zenith, ambient, bounding_radius, panorama_size, panorama_scale, panorama_turns]
        ),
        twin!(
            "SceneCounts",
            SceneCounts,
            [list_ends, list_begin, lights, shadow_lights, max_tree_steps, lamps, lamp_power]
        ),
        twin!("ShapeRecord", ShapeRecord, [position, material, a, kind, b, index]),
        twin!("Scene", SceneBlock, [environment, counts, small_lights, small_list]),
        twin!("Counters", Counters, [rays, rejected_samples, listed_samples]),
        twin!(
            "Camera",
            Camera,
            [
                eye,
                lens_radius,
                u,
                inverse_focal_distance,
                v,
                inverse_view_distance,
                w,
                jitter,
                tilt,
                inverse_focal_length,
                dispersion
            ]
        ),
        twin!("Lattice", Lattice, [extent, origin, stride, first_row, row_step, row_count]),
        twin!("TracePush", TracePush, [camera, lattice, seed, limits, first_sample, sample_count]),
        twin!("AccumulatePush", AccumulatePush, [lattice, seed, first_sample, jitter, reach]),
        twin!("SelectPush", SelectPush, [lattice, threshold, cell]),
        twin!(
            "Aperture",
            Aperture,
            [
                stretch,
                blade_count,
                half_blade_angle,
                tan_half_blade,
                straight_share,
                inverse_straight_share,
                inverse_round_share,
                squared_apothem,
                roundness,
                cats_eye_shift,
                max_cats_eye_shift,
                cells,
                shutter,
                profile,
                axis
            ]
        ),
        twin!("ApertureBuffer", ApertureBuffer, [shape, edges]),
        twin!(
            "OverlayScale",
            OverlayScale,
            [kind, full_scale, blur, inverse_image_distance, inverse_focal_distance, gradient, axis]
        ),
        twin!("GeometryPush", GeometryPush, [camera, w, top, extent]),
        twin!("PickPush", PickPush, [camera, extent, position, fan, samples, seed]),
        twin!("PickedRay", PickedRay, [origin, distance, direction, material, focus]),
        twin!("ResolvePush", ResolvePush, [extent, preview_stride, exposure, overlay, blue_first]),
    ]
}

fn fault(layout: &StructLayout, (name, fields, size): &Twin) -> Option<String> {
    let members: Vec<_> = layout.members.iter().map(|(name, offset)| (name.as_str(), *offset)).collect();
    if members != *fields {
        return Some(format!("{name}: {members:?} in the shader, {fields:?} in Rust"));
    }
    match layout.stride {
        Some(stride) if stride != *size => {
            Some(format!("{name}: every {stride} bytes in the shader, {size} in Rust"))
        }
        _ => None,
    }
}

/// Catches a field added, moved or padded on one side only. Every struct of every shader has its
/// twin here, so a new one cannot be forgotten.
#[test]
fn every_struct_of_the_shaders_has_its_twin() {
    let twins = twins();
    let mut seen = Vec::new();
    for shader in SHADERS {
        for layout in shader.interface().structs {
            // The block around a runtime array has the array for its one member.
            let block = layout.members.len() == 1 && layout.members[0].1 == 0;
            let twin = twins.iter().find(|(name, ..)| *name == layout.name);
            match twin {
                Some(twin) => assert_eq!(fault(&layout, twin), None, "{}", shader.name),
                None => assert!(block, "{}: {layout:?} has no twin", shader.name),
            }
            seen.push(layout.name);
        }
        let push = shader.interface().push_size as usize;
        let sizes = [
            size_of::<TracePush>(),
            size_of::<AccumulatePush>(),
            size_of::<SelectPush>(),
            size_of::<ResolvePush>(),
            size_of::<PickPush>(),
            size_of::<GeometryPush>(),
        ];
        assert!(sizes.contains(&push), "{}: {push} bytes of push constants", shader.name);
        assert!(push <= 128, "{}: Vulkan promises 128 bytes", shader.name);
    }
    for (name, ..) in &twins {
        assert!(seen.iter().any(|seen| seen == name), "no shader has {name}");
    }
}

/// Catches a device that is taken for good enough although the shaders bind more, or refused although it is.
#[test]
fn what_a_device_must_bind_is_what_the_shaders_bind() {
    for (kind, needed) in NEEDED {
        let of = |shader: &Shader| {
            shader.interface().resources.values().filter(|resource| **resource == kind).count()
        };
        assert_eq!(SHADERS.iter().map(of).max(), Some(needed as usize), "{kind:?}");
    }
}

/// The binding of a name as GLSL writes it: of an image or texel buffer, or of a buffer's block.
fn binding_of(name: &str) -> Option<u32> {
    let mut upper = String::new();
    for letter in name.trim_end_matches("Buffer").chars() {
        if letter.is_uppercase() && !upper.is_empty() {
            upper.push('_');
        }
        upper.push(letter.to_ascii_uppercase());
    }
    let place = binding::NAMES.iter().position(|name| *name == upper)?;
    u32::try_from(place).ok()
}

/// Catches a resource that a shader declares at another one's binding: the numbers are right on both sides then,
/// but not the names.
#[test]
fn a_binding_is_the_same_resource_in_every_shader() {
    for shader in SHADERS {
        let interface = shader.interface();
        for (number, name) in &interface.names {
            assert_eq!(binding_of(name), Some(*number), "{}: {name}", shader.name);
        }
        assert_eq!(interface.names.len(), interface.resources.len(), "{}", shader.name);
    }
    assert_eq!(binding_of("KeptPixels"), Some(binding::KEPT_PIXELS));
    assert_eq!(binding_of("film_image"), Some(binding::FILM_IMAGE));
    assert_eq!(binding_of("Nothing"), None);
}

/// The check above must see a moved field and a wrong size.
#[test]
fn a_wrong_twin_is_found() {
    let interface = Trace::SHADERS[0].interface();
    let material = interface.structs.iter().find(|layout| layout.name == "Material").expect("it is used");
    let (name, mut fields, size) = twins().into_iter().find(|twin| twin.0 == "Material").expect("listed");
    assert!(fault(material, &(name, fields.clone(), size + 16)).is_some());
    fields[2].1 += 4;
    assert!(fault(material, &(name, fields, size)).is_some());
}
