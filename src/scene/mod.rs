//! Floor 5: the ECS.
