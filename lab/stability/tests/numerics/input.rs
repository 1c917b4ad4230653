//! What is read, and what machine it runs on.

super::cases! {
    case_62_ends_of_the_pools,
    case_63_nan_infinity_and_1e39_in_every_field,
    case_64_subnormal_fields,
    case_65_sign_of_zero,
    case_66_rays_that_are_no_rays,
    case_67_flush_to_zero,
    case_68_same_picture_on_every_machine,
    case_69_single_precision_on_every_scene,
}
