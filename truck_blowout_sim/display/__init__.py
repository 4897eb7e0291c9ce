"""What a viewer needs to show the truck: robot description, frames, tire force arrows."""
